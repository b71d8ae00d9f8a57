// SPDX-License-Identifier: MIT
// Storage of RowOrder for rows until their order is settled, and their output.
#include <algorithm>
#include <cstddef>
#include <iterator>

#include "lib/log/log_channels.hpp"
#include "lib/log/rows/row_order.hpp"

namespace faultline {

/// Removes rows from the store that were handed out or left out.
void RowOrder::forget_given() {
  int needed = judged_;
  for (const Row& row : order_) needed = std::min(needed, row.at);
  for (const Row& row : early_) needed = std::min(needed, row.at);
  if (needed < kOrderWindowRows) return;
  for_each_column(store_, store_, [&](std::vector<double>& values, const std::vector<double>&) {
    if (!values.empty()) values.erase(values.begin(), values.begin() + needed);
  });
  numbers_.erase(numbers_.begin(), numbers_.begin() + needed);
  for (Row& row : order_) row.at -= needed;
  for (Row& row : early_) row.at -= needed;
  judged_ -= needed;
}

bool RowOrder::give(Log& segment, int most) {
  std::size_t settled = order_.size();
  if (!finished_) {
    const std::size_t of_run = settled - run_begin_;
    settled -= std::min<std::size_t>(of_run, kOrderWindowRows);
  }
  std::size_t unread = 0;
  while (unread < settled && !run_at(order_[unread].time).is_read) ++unread;
  drop_first(unread);
  settled -= unread;
  std::size_t rows = 0;
  while (rows < settled && rows < static_cast<std::size_t>(most) && run_at(order_[rows].time).is_read) ++rows;
  if (rows == 0) return false;
  gather(segment, rows);
  drop_first(rows);
  return true;
}

void RowOrder::gather(Log& segment, std::size_t rows) const {
  bool is_one_piece = true;
  for (std::size_t k = 1; k < rows; ++k) is_one_piece = is_one_piece && order_[k].at == order_[k - 1].at + 1;
  for_each_column(segment, store_, [&](std::vector<double>& values, const std::vector<double>& all) {
    values.clear();
    if (all.empty()) return;
    if (is_one_piece) {
      const auto first = all.begin() + order_.front().at;
      values.assign(first, first + static_cast<std::ptrdiff_t>(rows));
      return;
    }
    for (std::size_t k = 0; k < rows; ++k) values.push_back(all[order_[k].at]);
  });
  const bool own_clock = wanted_run_ != kEveryRun;
  for (std::size_t k = 0; k < rows; ++k) segment.time[k] = own_clock ? order_[k].own : order_[k].time;
}

void RowOrder::drop_first(std::size_t rows) {
  order_.erase(order_.begin(), order_.begin() + static_cast<std::ptrdiff_t>(rows));
  run_begin_ -= std::min(run_begin_, rows);
}

const LogRun& RowOrder::run_at(double time) const {
  auto run = runs_.rbegin();
  while (std::next(run) != runs_.rend() && time < run->start_s) ++run;
  return *run;
}

std::vector<LogRun> RowOrder::runs() const {
  std::vector<LogRun> runs = runs_;
  if (wanted_run_ == kEveryRun) return runs;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    runs[i].start_s = own_spans_[i].start_s;
    runs[i].end_s = own_spans_[i].end_s;
    runs[i].clock_offset_s = 0.0;
  }
  return runs;
}

}  // namespace faultline
