// SPDX-License-Identifier: MIT
// Changes native logs and mends their checksums, so that what lies behind them is reached.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <random>
#include <string_view>

#include "formats/native/native_layout.hpp"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace faultline {
namespace {

constexpr std::uint64_t kOddRows[] = {0, 1, 8, 255, 65536, 65537, 1ULL << 31, 1ULL << 53, 1ULL << 63, ~0ULL};

std::string_view view(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// Mends the preface at the front of the bytes; its size with the hash, 0 when there is none. Counts its
/// channels.
std::size_t mend_preface(std::uint8_t* data, std::size_t size, std::size_t& channels) {
  NativePreface preface;
  const std::size_t least = sizeof preface + sizeof(std::uint64_t);
  if (size < least || view(data, kNativeMagic.size()) != kNativeMagic) return 0;
  std::memcpy(&preface, data, sizeof preface);
  preface.list_bytes = std::min(preface.list_bytes, static_cast<std::uint32_t>(size - least));
  std::memcpy(data, &preface, sizeof preface);
  const std::size_t hashed = sizeof preface + preface.list_bytes;
  const std::uint64_t hash = native_hash(view(data, hashed));
  std::memcpy(data + hashed, &hash, sizeof hash);
  channels = static_cast<std::size_t>(std::count(data + sizeof preface, data + hashed, '\n'));
  return hashed + sizeof hash;
}

void mend_header(std::uint8_t* data, std::size_t size, std::size_t channels, std::mt19937& random) {
  NativeChunkHeader header;
  std::memcpy(&header, data, sizeof header);
  if (random() % 16 == 0) header.rows = static_cast<std::uint32_t>(kOddRows[random() % std::size(kOddRows)]);
  if (random() % 16 == 0) header.first_row = kOddRows[random() % std::size(kOddRows)];
  const std::size_t row_bytes = header.marker == kProvenanceMarker ? 1 : channels * sizeof(double);
  const std::size_t bytes = header.rows * row_bytes;
  if (bytes <= size - sizeof header && random() % 8 != 0)
    header.data_hash = native_hash(view(data + sizeof header, bytes));
  if (random() % 16 != 0) header.own_hash = hash_of(header);
  std::memcpy(data, &header, sizeof header);
}

void mend(std::uint8_t* data, std::size_t size, std::mt19937& random) {
  std::size_t channels = 0, at = 0;
  for (std::size_t more; (more = mend_preface(data + at, size - at, channels)) > 0;) at += more;
  for (; at + sizeof(NativeChunkHeader) <= size; ++at) {
    std::uint32_t marker = 0;
    std::memcpy(&marker, data + at, sizeof marker);
    if (is_known_marker(marker)) mend_header(data + at, size - at, channels, random);
  }
}

}  // namespace
}  // namespace faultline

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned int seed) {
  std::mt19937 random(seed);
  const std::size_t changed = LLVMFuzzerMutate(data, size, max_size);
  if (random() % 8 != 0) faultline::mend(data, changed, random);
  return changed;
}
