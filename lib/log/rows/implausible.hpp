// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "lib/core/issue.hpp"
#include "lib/log/log.hpp"

namespace faultline {

/// Limit of magnitude that no joint signal or time in SI reaches; a number beyond it is damage.
inline constexpr double kImplausible = 1e12;

/// Replaces infinite or implausible values by NaN and adds an issue for each. Row i of the segment is data
/// row first_row + i + 1 of the file.
void blank_implausible(Log& segment, std::int64_t first_row, Issues& issues);

}  // namespace faultline
