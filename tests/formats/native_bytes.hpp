// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "formats/native/native_layout.hpp"

/// Native logs byte by byte, as no writer of today makes them.
namespace faultline {

template <typename Value>
std::string_view bytes_of_value(const Value& value) {
  return {reinterpret_cast<const char*>(&value), sizeof value};
}

/// One copy of the preface, of any version.
inline std::string native_preface_of(std::uint32_t version, std::string_view list) {
  NativePreface preface;
  std::copy(kNativeMagic.begin(), kNativeMagic.end(), preface.magic.begin());
  preface.version = version;
  preface.list_bytes = static_cast<std::uint32_t>(list.size());
  std::string bytes = std::string(bytes_of_value(preface)).append(list);
  return bytes.append(bytes_of_value(native_hash(bytes)));
}

/// Both copies of the preface.
inline std::string native_prefaces(std::string_view list) {
  const std::string one = native_preface(list);
  return one + one;
}

/// A header with a sound hash; `numbers` are those that its hash is of.
inline std::string native_header_of(std::uint32_t marker, std::uint32_t rows, std::uint64_t first_row,
                                    std::string_view numbers = {}) {
  NativeChunkHeader header{marker, rows, first_row, numbers.empty() ? 0 : native_hash(numbers), 0};
  header.own_hash = hash_of(header);
  return std::string(bytes_of_value(header));
}

/// A chunk whose columns stand one after another in `numbers`.
inline std::string native_chunk_of(std::uint32_t rows, std::uint64_t first_row,
                                   const std::vector<double>& numbers) {
  const std::string_view bytes{reinterpret_cast<const char*>(numbers.data()),
                               numbers.size() * sizeof(double)};
  return native_header_of(kChunkMarker, rows, first_row, bytes).append(bytes);
}

}  // namespace faultline
