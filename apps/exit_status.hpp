// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

namespace faultline {

/// What the program tells the shell; scripts rely on it.
inline constexpr int kNothingFound = 0;   ///< done, nothing wrong found
inline constexpr int kFindings = 1;       ///< done, with findings: a fault, a severe issue, a mismatch
inline constexpr int kUsageError = 2;     ///< command line or option file
inline constexpr int kFileError = 3;      ///< an input cannot be processed or a result cannot be written
inline constexpr int kInternalError = 4;  ///< a defect of the program, or no memory left

/// Runs `work` and returns its status; what it throws becomes one sentence on standard error and the status
/// that belongs to it.
int guarded(const std::function<int()>& work);

}  // namespace faultline
