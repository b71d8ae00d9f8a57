// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "lib/log/recorder/measured_row.hpp"

namespace faultline {

/// Stores the latest rows by a hash of all their digits, to find repeated rows.
class RowMemory {
 public:
  RowMemory();
  /// Adds a row with its index. Returns find(row) among the rows before.
  std::int64_t add(const MeasuredRow& row, std::int64_t index);
  /// Returns the index of the latest row with the same digits; -1 for none among about kRows rows.
  std::int64_t find(const MeasuredRow& row) const;
  void forget();

  static constexpr std::size_t kRows = 1 << 16;  // a minute at 1 kHz; 1 MiB

 private:
  struct Entry {
    std::uint64_t hash = 0;
    std::int64_t index = -1;
  };
  std::vector<Entry> entries_;
};

}  // namespace faultline
