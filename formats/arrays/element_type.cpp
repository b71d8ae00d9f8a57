// SPDX-License-Identifier: MIT
#include "formats/arrays/element_type.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

namespace faultline {
namespace {

template <typename Element>
void decode_as(const char* from, std::ptrdiff_t stride, bool swapped, std::size_t count, double* to) {
  for (std::size_t i = 0; i < count; ++i, from += stride) {
    std::array<char, sizeof(Element)> bytes;
    std::memcpy(bytes.data(), from, sizeof(Element));
    if (swapped) std::reverse(bytes.begin(), bytes.end());
    Element element;
    std::memcpy(&element, bytes.data(), sizeof element);
    to[i] = static_cast<double>(element);
  }
}

}  // namespace

std::size_t size_of(ElementType type) {
  switch (type) {
    case ElementType::i1:
    case ElementType::u1:
      return 1;
    case ElementType::i2:
    case ElementType::u2:
      return 2;
    case ElementType::f4:
    case ElementType::i4:
    case ElementType::u4:
      return 4;
    case ElementType::f8:
    case ElementType::i8:
    case ElementType::u8:
      return 8;
  }
  return 1;
}

void decode(const char* from, std::ptrdiff_t stride, ElementType type, bool swapped, std::size_t count,
            double* to) {
  switch (type) {
    case ElementType::f4:
      return decode_as<float>(from, stride, swapped, count, to);
    case ElementType::f8:
      return decode_as<double>(from, stride, swapped, count, to);
    case ElementType::i1:
      return decode_as<std::int8_t>(from, stride, swapped, count, to);
    case ElementType::i2:
      return decode_as<std::int16_t>(from, stride, swapped, count, to);
    case ElementType::i4:
      return decode_as<std::int32_t>(from, stride, swapped, count, to);
    case ElementType::i8:
      return decode_as<std::int64_t>(from, stride, swapped, count, to);
    case ElementType::u1:
      return decode_as<std::uint8_t>(from, stride, swapped, count, to);
    case ElementType::u2:
      return decode_as<std::uint16_t>(from, stride, swapped, count, to);
    case ElementType::u4:
      return decode_as<std::uint32_t>(from, stride, swapped, count, to);
    case ElementType::u8:
      return decode_as<std::uint64_t>(from, stride, swapped, count, to);
  }
}

}  // namespace faultline
