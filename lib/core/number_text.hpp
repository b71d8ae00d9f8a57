// SPDX-License-Identifier: MIT
#pragma once

#include <string>

/// Numbers as people read them; what programs read back is in csv_cell and json_values.
namespace faultline {

/// So many significant digits.
std::string digits_text(double value, int digits);

/// Three significant digits, whole below ten million; "-" for NaN.
std::string value_text(double value);

/// "96 %".
std::string percent_text(double share);

/// "4.210 s".
std::string seconds_text(double time_s);

/// "4.210 s", with decimals that show single samples of that period; "unknown" for NaN.
std::string time_text(double time_s, double sample_period_s);

/// Where axes of time begin to count: 0, or the whole second of a start that is so large (seconds since 1970)
/// that ticks would not show the digits that differ.
double time_zero(double start_s);

}  // namespace faultline
