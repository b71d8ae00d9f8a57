// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

/// Lists of a spec that hold one number a joint, or none for the default.
namespace faultline {

/// Each throws Error(usage) naming `key` when the list is neither empty nor of that many numbers, or when one
/// of them is not what it must be.
void check_count(int joints, const std::vector<double>& list, const char* key);
void check_positive(int joints, const std::vector<double>& list, const char* key);
void check_not_negative(int joints, const std::vector<double>& list, const char* key);

/// The list, or `joints` times `usual` when it is empty.
std::vector<double> or_all(const std::vector<double>& list, int joints, double usual);

}  // namespace faultline
