// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/explain/day_effects.hpp"

namespace faultline {

/// Friction so far beyond that of healthy days that it is a fault rather than an effect of the day, in a log
/// that shows no onset of it.
struct LastingFriction {
  DayEffect effect;
  double start_s = 0.0, end_s = 0.0;  ///< of the log
};

/// Returns the frictions of a log's day whose whole 95 % interval lies above twice the normal range.
std::vector<LastingFriction> lasting_friction(const std::vector<DayEffect>& day, double start_s,
                                              double end_s);

}  // namespace faultline
