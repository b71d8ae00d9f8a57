// SPDX-License-Identifier: MIT
#include "apps/suggestion/axis_guess.hpp"

#include <fmt/format.h>

#include "lib/log/units.hpp"

namespace faultline {
namespace {

constexpr double kRestSpan = 1e-3;  // rad or m: of a joint that holds its place
constexpr double kShortSpan = 0.6;  // rad or m: of what may slide
constexpr double kShorterSpan = 0.4;
constexpr double kToAndFro = 4.0;  // path to span, of a joint that uses all it has

}  // namespace

GuessedAxis guess_axis(const JointNumbers& joint, const GuessedUnits& units, const std::string& header) {
  const double span = joint.span * units.position_factor;
  const auto known = known_unit(units.position.unit);
  const Dimension dimension = known ? known->dimension : Dimension::none;
  if (dimension == Dimension::length)
    return {true, header.empty() ? "its numbers are those of a length" : "its header says " + header};
  if (dimension == Dimension::angle)
    return {false, header.empty() ? "its numbers are those of an angle" : "its header says " + header};
  if (span < kRestSpan) return {false, "? it rests, so that nothing tells whether it turns or slides"};
  if (span < kShortSpan && joint.carries)
    return {true, fmt::format("? its torque carries a weight all the time, and it spans {:.3g} m", span)};
  if (span < kShorterSpan && joint.path > kToAndFro * joint.span)
    return {true, fmt::format("? it goes to and fro over {:.3g}, little for an angle", span)};
  const std::string spans = fmt::format("spans {:.3g} rad", span);
  return {false, span < kShorterSpan ? "? it " + spans + ", which may be a slide's as well" : spans};
}

}  // namespace faultline
