// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace faultline {

enum class ElementType { f4, f8, i1, i2, i4, i8, u1, u2, u4, u8 };

std::size_t size_of(ElementType type);

/// Elements that lie `stride` bytes apart from `from` on, as doubles. `swapped` when their byte order is not
/// the processor's.
void decode(const char* from, std::ptrdiff_t stride, ElementType type, bool swapped, std::size_t count,
            double* to);

}  // namespace faultline
