// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "lib/log/log_source.hpp"

namespace faultline {

struct DeriveOptions {
  int half_width = 2;  ///< samples on either side from which the velocity of a row is estimated; at least 1
};

/// Returns the log with velocities: if it records none, the velocity of a sample is the slope of the
/// least-squares parabola through the positions around it (Savitzky and Golay, on the recorded times),
/// without missing positions; NaN with fewer than three. A log that records velocities passes unchanged.
std::unique_ptr<LogSource> with_velocity(std::unique_ptr<LogSource> source,
                                         const DeriveOptions& options = {});

/// Returns the slope at time[at] of the parabola through the finite values of rows [begin, end); NaN with
/// fewer than three.
double parabola_slope(const std::vector<double>& time, const std::vector<double>& values, int begin, int end,
                      int at);

}  // namespace faultline
