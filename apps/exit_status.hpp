// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

namespace faultline {

/// Exit statuses of the program; scripts rely on them.
inline constexpr int kNothingFound = 0;   ///< done, nothing wrong found
inline constexpr int kFindings = 1;       ///< done, with findings: a fault, a severe issue, a mismatch
inline constexpr int kUsageError = 2;     ///< error in the command line or an option file
inline constexpr int kFileError = 3;      ///< an input cannot be processed or a result cannot be written
inline constexpr int kInternalError = 4;  ///< a defect of the program, or out of memory

/// Runs `work` and returns its status; an exception is printed as one sentence on standard error and gives
/// the status that belongs to it.
int guarded(const std::function<int()>& work);

}  // namespace faultline
