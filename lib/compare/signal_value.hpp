// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <vector>

namespace faultline {

/// Stands for a value, or a time, that there is none of.
inline constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();

/// Sample periods without a sample that are a gap.
inline constexpr double kGapPeriods = 4.0;

/// A signal between its samples.
struct ValueBetween {
  double value = 0.0;  ///< NaN outside the signal, in a gap and beside a missing sample
  double error = 0.0;  ///< how far off it may be, from how much a point more changes it
};

/// By the cubic through four samples around `at`. `gap_s`: samples further apart have nothing between them.
ValueBetween value_between(const std::vector<double>& time, const std::vector<double>& values, double at,
                           double gap_s);

/// Standard deviation of the noise of a signal from its own third differences, which slow motion leaves no
/// trace in: robust (a median), at least what the step of its values makes, 0 for fewer than four samples.
double noise_of(const std::vector<double>& values);

}  // namespace faultline
