// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "lib/evidence/learn/match_noise.hpp"
#include "lib/evidence/motion_model.hpp"

namespace faultline {

/// What a motion from one rest to the next says of the mass at the tip by itself.
struct CarriedLevel {
  double kg = 0.0;  ///< beside what was identified
  double std = 0.0;
  std::array<double, kMaxJoints> way{};  ///< of sliding axes, where it ends less where it began, m
};

/// The levels of the motions of an excerpt, in the order of time: the tip's mass may be another after every
/// rest. `model` is one whose coloured torques are small: matched to logs whose work piece nobody knew, they
/// take most of what it weighs.
std::vector<CarriedLevel> carried_levels(const MotionModel& model, const HealthyExcerpt& excerpt);

/// The mass, kg, by which the levels of the logs jump between two values, several times within a log; 0 where
/// they scatter around one, differ from log to log only, or differ with the direction of a sliding
/// axis, as its friction would.
double mass_that_comes_and_goes(const std::vector<std::vector<CarriedLevel>>& logs);

}  // namespace faultline
