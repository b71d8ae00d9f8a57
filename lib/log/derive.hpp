// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "lib/log/log_source.hpp"

namespace faultline {

/// Returns the log with velocities: if it records none, the velocity of a sample is the slope of the
/// least-squares parabola through the positions around it (Savitzky and Golay, on the recorded times),
/// without missing positions; NaN with fewer than three. A log that records velocities passes unchanged.
std::unique_ptr<LogSource> with_velocity(std::unique_ptr<LogSource> source);

}  // namespace faultline
