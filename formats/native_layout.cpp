// SPDX-License-Identifier: MIT
#include "formats/native_layout.hpp"

#include <xxhash.h>

#include <cstddef>

namespace faultline {

std::uint64_t native_hash(std::string_view bytes) { return XXH3_64bits(bytes.data(), bytes.size()); }

std::uint64_t hash_of(const NativeChunkHeader& header) {
  return native_hash({reinterpret_cast<const char*>(&header), offsetof(NativeChunkHeader, own_hash)});
}

bool is_sound(const NativeChunkHeader& header) {
  const bool known = header.marker == kEndMarker || (header.marker == kChunkMarker && header.rows > 0);
  return known && header.rows <= kMostChunkRows && header.own_hash == hash_of(header);
}

}  // namespace faultline
