// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "lib/log/log_source.hpp"

namespace faultline {

struct DeriveOptions {
  int half_width = 2;  ///< samples on either side that the velocity of a row is taken from; at least 1
};

/// The same log with velocities: a log that records none gets the slope at each sample of the least-squares
/// parabola through the positions around it (Savitzky and Golay, on the recorded times). Missing positions
/// are left out of it; fewer than three give a missing velocity. A log that records velocities passes
/// unchanged.
std::unique_ptr<LogSource> with_velocity(std::unique_ptr<LogSource> source,
                                         const DeriveOptions& options = {});

/// Slope at time[at] of the parabola through the finite values of rows [begin, end); NaN with fewer than
/// three.
double parabola_slope(const std::vector<double>& time, const std::vector<double>& values, int begin, int end,
                      int at);

}  // namespace faultline
