// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "lib/log/log_source.hpp"

namespace faultline {

/// Rows of a log from `begin` up to, not including, `end`.
struct RowRange {
  std::int64_t begin = 0;
  std::int64_t end = 0;
};

/// A log that hands out only some of its rows; the others are a gap. All else passes unchanged.
class SelectedRowsSource : public LogSource {
 public:
  /// `source` is at its first row and has no other reader; it outlives this. The ranges ascend and do not
  /// overlap.
  SelectedRowsSource(LogSource& source, std::vector<RowRange> ranges);

  bool next(Log& segment) override;
  void rewind() override;
  const LogIdentity& identity() const override { return source_.identity(); }
  const Issues& issues() const override { return source_.issues(); }
  double share_read() const override { return source_.share_read(); }

 private:
  LogSource& source_;
  std::vector<RowRange> ranges_;
  Log rows_;               ///< the segment of the source that is being handed out
  std::int64_t told_ = 0;  ///< rows before this one are handed out or skipped
  std::size_t range_ = 0;
};

}  // namespace faultline
