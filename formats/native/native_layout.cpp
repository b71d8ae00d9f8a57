// SPDX-License-Identifier: MIT
#include "formats/native/native_layout.hpp"

#include <xxhash.h>

#include <algorithm>
#include <cstddef>

namespace faultline {
namespace {

constexpr std::uint64_t kFewestRows = 8, kUsualRows = 256;
constexpr std::uint64_t kRowsBeforeOne = 32;  ///< rows before a chunk for each row in it

template <typename Value>
std::string_view bytes_of(const Value& value) {
  return {reinterpret_cast<const char*>(&value), sizeof value};
}

}  // namespace

std::uint64_t native_hash(std::string_view bytes) { return XXH3_64bits(bytes.data(), bytes.size()); }

std::uint64_t hash_of(const NativeChunkHeader& header) {
  return native_hash({reinterpret_cast<const char*>(&header), offsetof(NativeChunkHeader, own_hash)});
}

bool is_known_marker(std::uint32_t marker) {
  return marker == kChunkMarker || marker == kProvenanceMarker || marker == kEndMarker;
}

bool is_sound(const NativeChunkHeader& header) {
  const bool known = is_known_marker(header.marker) && (header.marker != kChunkMarker || header.rows > 0);
  return known && header.rows <= kMostChunkRows && header.first_row <= kMostRows - header.rows &&
         header.own_hash == hash_of(header);
}

std::string native_preface(std::string_view list) {
  NativePreface preface;
  std::copy(kNativeMagic.begin(), kNativeMagic.end(), preface.magic.begin());
  preface.list_bytes = static_cast<std::uint32_t>(list.size());
  std::string bytes(bytes_of(preface));
  bytes += list;
  bytes += bytes_of(native_hash(bytes));
  return bytes;
}

std::uint32_t native_chunk_rows(std::uint64_t first_row) {
  return static_cast<std::uint32_t>(std::clamp(first_row / kRowsBeforeOne, kFewestRows, kUsualRows));
}

}  // namespace faultline
