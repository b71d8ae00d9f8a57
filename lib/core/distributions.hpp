// SPDX-License-Identifier: MIT
#pragma once

/// How likely so large a value is by chance alone.
namespace faultline {

/// A normal variable is within so many standard deviations with 95 %.
inline constexpr double kNormal95 = 1.959963984540054;

/// P(X > x) of a chi-square variable with so many degrees of freedom, at least 1; 1 for x <= 0.
double chi_square_tail(double x, int degrees);

/// P(|T| > |t|) of Student's t with so many degrees of freedom, at least 1.
double student_tail(double t, int degrees);

/// P(|Z| > |z|) of a standard normal variable.
double normal_tail(double z);

}  // namespace faultline
