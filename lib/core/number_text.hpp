// SPDX-License-Identifier: MIT
#pragma once

#include <string>

/// Numbers for readers; for numbers that programs read back see csv_cell and json_values.
namespace faultline {

/// Returns the number with so many significant digits.
std::string digits_text(double value, int digits);

/// Returns three significant digits, but the whole integer part below ten million; "-" for NaN.
std::string value_text(double value);

/// Returns "96 %" for .96.
std::string percent_text(double share);

/// Returns "4.210 s".
std::string seconds_text(double time_s);

/// Returns "4.210 s", with enough decimals to distinguish samples of that period; "unknown" if not finite.
std::string time_text(double time_s, double sample_period_s);

/// Returns the zero of a time axis: 0, or the whole second of a start so large (seconds since 1970) that
/// ticks would not show the digits that differ.
double time_zero(double start_s);

}  // namespace faultline
