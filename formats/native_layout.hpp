// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <string_view>

namespace faultline {

// The native format, byte for byte as docs/formats-native.md describes it.
static_assert(std::endian::native == std::endian::little, "numbers are stored as they lie in memory");

inline constexpr std::string_view kNativeMagic{
    "\x89"
    "FLOG\r\n\x1a",
    8};
inline constexpr std::uint32_t kNativeVersion = 1;
inline constexpr std::uint32_t kChunkMarker = 0x4b4e4843;  ///< "CHNK"
inline constexpr std::uint32_t kEndMarker = 0x454e4f44;    ///< "DONE"
inline constexpr std::uint32_t kChunkRows = 4096;          ///< of every chunk but the last
inline constexpr std::uint32_t kMostChunkRows = 1 << 16;   ///< a reader accepts

/// What stands before the channel list.
struct NativePreface {
  std::array<char, 8> magic{};
  std::uint32_t version = kNativeVersion;
  std::uint32_t list_bytes = 0;  ///< of the channel list that follows
};
static_assert(sizeof(NativePreface) == 16);

/// What stands before the numbers of a chunk, and at the end of the file.
struct NativeChunkHeader {
  std::uint32_t marker = kChunkMarker;
  std::uint32_t rows = 0;
  std::uint64_t first_row = 0;  ///< of the chunk, from 0; at the end of the file all rows
  std::uint64_t data_hash = 0;  ///< XXH3 of the numbers
  std::uint64_t own_hash = 0;   ///< XXH3 of the 24 bytes before
};
static_assert(sizeof(NativeChunkHeader) == 32);

std::uint64_t native_hash(std::string_view bytes);
/// Of the fields before `own_hash`.
std::uint64_t hash_of(const NativeChunkHeader& header);
/// True when the header is undamaged and of a kind a reader knows.
bool is_sound(const NativeChunkHeader& header);

}  // namespace faultline
