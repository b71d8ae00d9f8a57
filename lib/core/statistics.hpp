// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

namespace faultline {

// Order statistics. Each is one of the values (nothing is interpolated), or NaN if there are none; no value
// may be NaN.

/// Returns the middle value; for an even number the larger of the two in the middle.
double upper_median(std::vector<double> values);
/// The same without a copy: reorders `values`.
double upper_median_of(std::span<double> values);

/// Returns the value with floor(share n) values before it, the largest for a share of 1; upper_quantile(0.5)
/// is upper_median.
double upper_quantile(std::vector<double> values, double share);

/// Returns the value with floor(share (n - 1)) values before it.
double lower_quantile(std::vector<double> values, double share);

/// Returns the smallest value that at least `share` of the values do not exceed.
double nearest_rank_quantile(std::vector<double> values, double share);

// Tail probabilities.

/// A normal variable is within this number of standard deviations with 95 %.
inline constexpr double kNormal95 = 1.959963984540054;

/// Returns P(X > x) of a chi-square variable with so many degrees of freedom, at least 1; 1 for x <= 0.
double chi_square_tail(double x, int degrees);

/// Returns P(|T| > |t|) of Student's t with so many degrees of freedom, at least 1.
double student_tail(double t, int degrees);

/// Returns P(|Z| > |z|) of a standard normal variable.
double normal_tail(double z);

}  // namespace faultline
