// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace faultline {

/// Number of bytes before and after a text of numbers that must be readable; their values are irrelevant.
inline constexpr std::size_t kNumberMargin = 64;

/// Reads the number that fills [begin, end) as fast_float::from_chars does, correctly rounded; false for
/// anything else.
bool read_number(const char* begin, const char* end, char decimal, double& value);

/// Reads rows of only numbers, separators and empty cells (NaN) with the 32-byte registers of the processor:
/// first the ends of the fields in some KiB of text, then each number between two ends, independent of the
/// one before it. The numbers are those that read_number() gives.
class WideRows {
 public:
  WideRows(char separator, char decimal) : separator_(separator), decimal_(decimal) {}

  /// True when the processor has the instructions and the table has single separators.
  bool can_read() const;
  /// Reads lines from `p` on into rows `row` up to `max_rows` of `columns`, one for each field and null for
  /// one that is not wanted, and moves `p` behind them. Stops at the first line with anything else, or too
  /// long; returns the number of lines read. `end` is after a newline; kNumberMargin bytes on both sides must
  /// be readable.
  int read(const char*& p, const char* end, const std::vector<double*>& columns, int row, int max_rows);

 private:
  static constexpr int kMostBytes = 1 << 14, kLeastBytes = 1 << 10;
  static constexpr int kAhead = 64;  ///< ends that may be written after the last one

  int find_ends(const char* text, int size);
  const char* read_row(const char* text, const char* p, const std::uint32_t* ends,
                       const std::vector<double*>& columns, int row) const;

  char separator_, decimal_;
  int bytes_ = kLeastBytes;  ///< text bytes processed together: fewer after a row for read_any()
  std::array<std::uint32_t, kMostBytes + kAhead> ends_{};
};

}  // namespace faultline
