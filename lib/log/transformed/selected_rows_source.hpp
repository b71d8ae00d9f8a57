// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "lib/log/transformed/changed_source.hpp"

namespace faultline {

/// Rows of a log from `begin` up to, not including, `end`.
struct RowRange {
  std::int64_t begin = 0;
  std::int64_t end = 0;
};

/// Hands out only some rows of a log; the others are a gap. All else passes unchanged.
class SelectedRows {
 public:
  /// The ranges ascend and do not overlap.
  SelectedRows(std::vector<RowRange> ranges) : ranges_(std::move(ranges)) {}

  bool next(LogSource& source, Log& segment) {
    for (;;) {
      const std::int64_t last = rows_.first_row + rows_.rows();
      while (range_ < ranges_.size() && ranges_[range_].end <= told_) ++range_;
      const std::int64_t begin = range_ < ranges_.size() ? std::max(ranges_[range_].begin, told_) : last;
      if (begin < last) {
        told_ = std::min(ranges_[range_].end, last);
        segment = slice(rows_, static_cast<int>(begin - rows_.first_row),
                        static_cast<int>(told_ - rows_.first_row));
        return true;
      }
      if (!source.next(rows_)) return false;
      told_ = rows_.first_row;
    }
  }

 private:
  std::vector<RowRange> ranges_;
  Log rows_;               ///< the segment of the source that is being handed out
  std::int64_t told_ = 0;  ///< rows before this one are handed out or skipped
  std::size_t range_ = 0;
};

using SelectedRowsSource = StagedSource<SelectedRows>;

}  // namespace faultline
