// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>

#include "lib/log/log_source.hpp"

namespace faultline {

/// Whether the velocity of a joint is a backward, forward or central difference of its position, over the
/// stamps or over the usual period. Rows with an unchanged position do not count. False for fewer than 8 rows
/// or for positions without noise.
bool is_difference(std::span<const double> time, std::span<const double> q, std::span<const double> dq);

/// Time by which a velocity is late, against the derivative of the position.
struct VelocityDelay {
  double delay_s = 0.0;
  bool matters = false;  ///< it is certain, half a row or more, and causes errors larger than the noise
};

/// Estimates the delay d of a velocity by least squares: dq(t) = v(t - d) is v(t) - d v'(t), where v and v'
/// are central differences of the position over about 25 ms, whose noise does not bias d.
VelocityDelay velocity_delay(std::span<const double> time, std::span<const double> q,
                             std::span<const double> dq);

/// Whether a velocity was computed from the position, and so is no independent measurement: it is a
/// difference, or late or early as that of a filter is.
bool is_derived(std::span<const double> time, std::span<const double> q, std::span<const double> dq);

/// Returns the log with velocities: if it records none, the velocity of a sample is the slope of the
/// least-squares parabola through the positions around it (Savitzky and Golay, on the recorded times),
/// without missing positions; NaN with fewer than three. A log that records velocities passes unchanged.
std::unique_ptr<LogSource> with_velocity(std::unique_ptr<LogSource> source);

}  // namespace faultline
