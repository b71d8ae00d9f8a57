// SPDX-License-Identifier: MIT
#include "lib/log/recorder/wrapped_angle.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace faultline {
namespace {

constexpr double kWholeTurn = 2.0 * std::numbers::pi;
constexpr double kBorderRounding = 1e-3;  // rad, by which a printed border may be rounded
constexpr double kNear = 0.25;            // of a turn, from the angle that the velocity predicts
constexpr double kSmallStep = 0.1;        // of a turn: a longer step does not predict the next one

/// Whether both angles lie in one turn that begins at `border`.
bool within(double a, double b, double border) {
  return std::min(a, b) >= border - kBorderRounding &&
         std::max(a, b) <= border + kWholeTurn + kBorderRounding;
}

}  // namespace

double WrappedAngle::unwrapped(double t, double q, double dq, double longest_s) {
  has_wrapped_ = false;
  if (std::isnan(q)) return q;
  const double moved = q - q_;
  if (begun_ && std::abs(moved) > std::numbers::pi && t - t_ < longest_s &&
      (within(q, q_, -std::numbers::pi) || within(q, q_, 0.0))) {
    const double way = 0.5 * (dq + dq_) * (t - t_);
    const bool has_way = std::isfinite(way);
    const double expected = has_way ? way : step_, near = has_way ? kNear : kSmallStep;
    const double turns = std::round((expected - moved) / kWholeTurn);
    has_wrapped_ = turns != 0.0 && (has_way || std::abs(step_) < kSmallStep * kWholeTurn) &&
                   std::abs(moved + turns * kWholeTurn - expected) < near * kWholeTurn;
    if (has_wrapped_) turns_ += turns;
  }
  if (begun_) step_ = has_wrapped_ ? std::remainder(moved, kWholeTurn) : moved;
  begun_ = true;
  t_ = t, q_ = q, dq_ = dq;
  return q + turns_ * kWholeTurn;
}

}  // namespace faultline
