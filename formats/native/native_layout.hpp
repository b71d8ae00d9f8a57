// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <string_view>

namespace faultline {

// The native format, byte for byte as docs/formats-native.md describes it.
static_assert(std::endian::native == std::endian::little, "numbers are stored as they lie in memory");

inline constexpr std::string_view kNativeMagic{
    "\x89"
    "FLOG\r\n\x1a",
    8};
inline constexpr std::uint32_t kNativeVersion = 2;
inline constexpr std::uint32_t kChunkMarker = 0x4b4e4843;       ///< "CHNK"
inline constexpr std::uint32_t kProvenanceMarker = 0x564f5250;  ///< "PROV"
inline constexpr std::uint32_t kEndMarker = 0x454e4f44;         ///< "DONE"

// Limits that a reader requires and a writer keeps.
inline constexpr std::uint32_t kMostChunkRows = 1 << 16;
inline constexpr std::uint64_t kMostRows = 1ULL << 53;  ///< of a file
inline constexpr std::uint32_t kLongestList = 1 << 22;  ///< bytes of the channel list
inline constexpr std::size_t kMostChannels = 1 << 14;

/// The bytes before the channel list.
struct NativePreface {
  std::array<char, 8> magic{};
  std::uint32_t version = kNativeVersion;
  std::uint32_t list_bytes = 0;  ///< of the channel list that follows
};
static_assert(sizeof(NativePreface) == 16);

/// The bytes before the numbers of a chunk, and at the end of the file.
struct NativeChunkHeader {
  std::uint32_t marker = kChunkMarker;
  std::uint32_t rows = 0;       ///< for provenance, bytes
  std::uint64_t first_row = 0;  ///< of the chunk, from 0; in the end mark the number of all rows
  std::uint64_t data_hash = 0;  ///< XXH3 of the numbers
  std::uint64_t own_hash = 0;   ///< XXH3 of the 24 bytes before
};
static_assert(sizeof(NativeChunkHeader) == 32);

/// True when a header of a known kind begins with this marker.
bool is_known_marker(std::uint32_t marker);
std::uint64_t native_hash(std::string_view bytes);
/// Returns the hash of the fields before `own_hash`.
std::uint64_t hash_of(const NativeChunkHeader& header);
/// True when the header is undamaged, of a known kind, and its numbers of rows are within the limits.
bool is_sound(const NativeChunkHeader& header);

/// Returns one copy of the preface with a channel list and the hash of both.
std::string native_preface(std::string_view list);

/// Returns the number of rows of the chunk that begins with row `first_row`, unless the log ends before: few
/// in a short log, so that damage destroys only a small part of it.
std::uint32_t native_chunk_rows(std::uint64_t first_row);

}  // namespace faultline
