// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace faultline {

/// Reads rows of nothing but numbers, separators and empty cells (NaN) with the processor's 32-byte
/// registers: first where the fields end, some KiB of text at a time, then each number between two ends,
/// which need not wait for the one before it. The numbers are those that read_number() gives.
class WideRows {
 public:
  WideRows(char separator, char decimal) : separator_(separator), decimal_(decimal) {}

  /// Whether this processor has what it takes and the table is one of single separators.
  bool can_read() const;
  /// Reads lines from `p` on into rows `row` up to `max_rows` of `columns`, one for each field and null for
  /// one that is not wanted, and moves `p` behind them. Stops at the first line that is anything else, or too
  /// long; returns how many it read. `end` is behind a newline; kNumberMargin bytes on both sides must be
  /// readable.
  int read(const char*& p, const char* end, const std::vector<double*>& columns, int row, int max_rows);

 private:
  static constexpr int kMostBytes = 1 << 14, kLeastBytes = 1 << 10;
  static constexpr int kAhead = 64;  ///< ends that may be written behind the last one

  int find_ends(const char* text, int size);
  const char* read_row(const char* text, const char* p, const std::uint32_t* ends,
                       const std::vector<double*>& columns, int row) const;

  char separator_, decimal_;
  int bytes_ = kLeastBytes;  ///< of text that are looked at together: fewer where rows need care
  std::array<std::uint32_t, kMostBytes + kAhead> ends_{};
};

}  // namespace faultline
