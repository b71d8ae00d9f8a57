// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace faultline {

/// Number of bytes before and after a text of numbers that must be readable; their values are irrelevant.
inline constexpr std::size_t kNumberMargin = 64;

/// Reads the number that fills [begin, end) as fast_float::from_chars does, correctly rounded; false for
/// anything else.
bool read_number(const char* begin, const char* end, char decimal, double& value);

}  // namespace faultline
