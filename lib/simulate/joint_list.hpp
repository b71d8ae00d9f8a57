// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

/// Checks of a spec, and its lists that hold one number for each joint, or none for the default.
namespace faultline {

/// Throws Error(usage) with what was expected and found for `key`.
[[noreturn]] void bad_value(const std::string& key, const std::string& message);

/// Each throws Error(usage) naming `key` if the list has another length than 0 or `joints`, or if a number is
/// not positive or is negative, respectively.
void check_count(int joints, const std::vector<double>& list, const char* key);
void check_positive(int joints, const std::vector<double>& list, const char* key);
void check_not_negative(int joints, const std::vector<double>& list, const char* key);

/// Returns the list, or `joints` times `usual` if it is empty.
std::vector<double> or_all(const std::vector<double>& list, int joints, double usual);

}  // namespace faultline
