// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "lib/log/transformed/changed_source.hpp"

namespace faultline {

/// Inserts an empty row (all values missing) for each row that is missing between two others on a regular
/// clock, so that every stage treats a lost row like one recorded without values. Gaps of more than
/// kMostEmptyRows rows, and those on a clock with jitter, stay gaps. The inserted rows are no rows of the
/// log: identity() and issues() do not count them.
class InsertedRows {
 public:
  bool next(LogSource& source, Log& segment);
  /// Returns the number of rows inserted so far.
  std::int64_t rows_put_in() const { return given_ - rows_; }

 private:
  bool read_head(LogSource& source);
  int missing_before(double time);
  void follow_clock(double step);

  Log head_;              ///< first rows, from which the period is estimated; handed out first
  bool started_ = false;  ///< whether head_ was read
  double period_s_ = 0.0, jitter_ = 0.0, last_s_ = 0.0;  ///< jitter: mean deviation of a step, in periods
  std::int64_t rows_ = 0, given_ = 0;
  std::int64_t off_grid_ = 0;  ///< steps so far that are not a whole number of periods
};

using EmptyRowsSource = StagedSource<InsertedRows>;

/// Most missing rows that are inserted; more of them are a gap.
inline constexpr int kMostEmptyRows = 4;

}  // namespace faultline
