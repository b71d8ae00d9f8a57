// SPDX-License-Identifier: MIT
#include "lib/log/transformed/selected_rows_source.hpp"

#include <algorithm>
#include <utility>

namespace faultline {

SelectedRowsSource::SelectedRowsSource(LogSource& source, std::vector<RowRange> ranges)
    : ChangedSource(source), ranges_(std::move(ranges)) {}

void SelectedRowsSource::rewind() {
  source_.rewind();
  rows_ = {};
  told_ = 0;
  range_ = 0;
}

bool SelectedRowsSource::next(Log& segment) {
  for (;;) {
    const std::int64_t last = rows_.first_row + rows_.rows();
    while (range_ < ranges_.size() && ranges_[range_].end <= told_) ++range_;
    const std::int64_t begin = range_ < ranges_.size() ? std::max(ranges_[range_].begin, told_) : last;
    if (begin < last) {
      told_ = std::min(ranges_[range_].end, last);
      segment =
          slice(rows_, static_cast<int>(begin - rows_.first_row), static_cast<int>(told_ - rows_.first_row));
      return true;
    }
    if (!source_.next(rows_)) return false;
    told_ = rows_.first_row;
  }
}

}  // namespace faultline
