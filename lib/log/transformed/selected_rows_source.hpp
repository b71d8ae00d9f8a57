// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "lib/log/transformed/changed_source.hpp"

namespace faultline {

/// Rows of a log from `begin` up to, not including, `end`.
struct RowRange {
  std::int64_t begin = 0;
  std::int64_t end = 0;
};

/// A log that hands out only some of its rows; the others are a gap. All else passes unchanged.
class SelectedRowsSource : public ChangedSource {
 public:
  /// The ranges ascend and do not overlap.
  SelectedRowsSource(LogSource& source, std::vector<RowRange> ranges);

  bool next(Log& segment) override;
  void rewind() override;

 private:
  std::vector<RowRange> ranges_;
  Log rows_;               ///< the segment of the source that is being handed out
  std::int64_t told_ = 0;  ///< rows before this one are handed out or skipped
  std::size_t range_ = 0;
};

}  // namespace faultline
