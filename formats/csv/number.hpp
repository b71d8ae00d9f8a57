// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace faultline {

/// Bytes before and behind a text of numbers that must be there to be looked at; what they are does not
/// matter.
inline constexpr std::size_t kNumberMargin = 64;

/// Reads the number that fills [begin, end) as fast_float::from_chars does, correctly rounded; false when it
/// is none, or something is behind it.
bool read_number(const char* begin, const char* end, char decimal, double& value);

}  // namespace faultline
