// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <vector>

namespace faultline {

/// Marks a missing value or time.
inline constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();

/// Sample periods without a sample from which on there is a gap.
inline constexpr double kGapPeriods = 4.0;

/// A signal's value between its samples.
struct ValueBetween {
  double value = 0.0;  ///< NaN outside the signal, in a gap and beside a missing sample
  double error = 0.0;  ///< estimated error: the change by one more sample
};

/// Interpolates by the cubic through four samples around `at`, but not between samples over `gap_s` apart.
ValueBetween value_between(const std::vector<double>& time, const std::vector<double>& values, double at,
                           double gap_s);

/// Returns the standard deviation of a signal's noise from its third differences, which slow motion hardly
/// affects: robust (a median), at least that of its quantisation step, 0 for fewer than four samples.
double noise_of(const std::vector<double>& values);

}  // namespace faultline
