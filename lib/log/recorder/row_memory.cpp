// SPDX-License-Identifier: MIT
#include "lib/log/recorder/row_memory.hpp"

#include <bit>
#include <utility>

namespace faultline {
namespace {

/// FNV-1a over 64-bit words; a shift after each makes the low bits depend on all bits.
std::uint64_t hash_of(const MeasuredRow& row) {
  constexpr std::uint64_t kOffset = 14695981039346656037ULL, kPrime = 1099511628211ULL;
  constexpr int kHalf = 32;
  std::uint64_t hash = kOffset;
  for (const double value : row.values) {
    hash = (hash ^ std::bit_cast<std::uint64_t>(value)) * kPrime;
    hash ^= hash >> kHalf;
  }
  return hash;
}

}  // namespace

RowMemory::RowMemory() : entries_(kRows) {}

std::int64_t RowMemory::add(const MeasuredRow& row, std::int64_t index) {
  const std::uint64_t hash = hash_of(row);
  const Entry before = std::exchange(entries_[hash % kRows], {hash, index});
  return before.hash == hash ? before.index : -1;
}

std::int64_t RowMemory::find(const MeasuredRow& row) const {
  const std::uint64_t hash = hash_of(row);
  const Entry& entry = entries_[hash % kRows];
  return entry.hash == hash ? entry.index : -1;
}

void RowMemory::forget() { entries_.assign(kRows, {}); }

}  // namespace faultline
