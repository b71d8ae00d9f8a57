// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "lib/core/issue.hpp"
#include "lib/log/log.hpp"

namespace faultline {

/// A magnitude that no joint signal or time in SI reaches; beyond it a number is damage, not measurement.
inline constexpr double kImplausible = 1e12;

/// Values that are infinite or implausible become NaN; each is an issue. Row i of the segment is data row
/// first_row + i + 1 of the file.
void blank_implausible(Log& segment, std::int64_t first_row, Issues& issues);

}  // namespace faultline
