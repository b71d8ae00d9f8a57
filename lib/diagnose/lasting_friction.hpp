// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/explain/day_effects.hpp"

namespace faultline {

/// Friction so far beyond that of healthy days that it is no condition of the day any more, in a log that
/// shows no onset of it.
struct LastingFriction {
  DayEffect effect;
  double start_s = 0.0, end_s = 0.0;  ///< of the log
};

/// Of the effects of a log's day, the frictions whose whole interval lies beyond twice the normal range.
std::vector<LastingFriction> lasting_friction(const std::vector<DayEffect>& day, double start_s,
                                              double end_s);

}  // namespace faultline
