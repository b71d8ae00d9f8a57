// SPDX-License-Identifier: MIT
#include "lib/diagnose/lasting_friction.hpp"

#include "lib/core/distributions.hpp"

namespace faultline {
namespace {

constexpr double kFar = 2.0;  // normal ranges: friction above this is a fault

}  // namespace

std::vector<LastingFriction> lasting_friction(const std::vector<DayEffect>& day, double start_s,
                                              double end_s) {
  std::vector<LastingFriction> out;
  for (const DayEffect& effect : day)
    if (effect.kind == DayEffectKind::friction &&
        effect.value - kNormal95 * effect.std > kFar * effect.normal_range())
      out.push_back({effect, start_s, end_s});
  return out;
}

}  // namespace faultline
