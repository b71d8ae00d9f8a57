// SPDX-License-Identifier: MIT
#pragma once

/// Tail probabilities.
namespace faultline {

/// A normal variable is within this number of standard deviations with 95 %.
inline constexpr double kNormal95 = 1.959963984540054;

/// Returns P(X > x) of a chi-square variable with so many degrees of freedom, at least 1; 1 for x <= 0.
double chi_square_tail(double x, int degrees);

/// Returns P(|T| > |t|) of Student's t with so many degrees of freedom, at least 1.
double student_tail(double t, int degrees);

/// Returns P(|Z| > |z|) of a standard normal variable.
double normal_tail(double z);

}  // namespace faultline
