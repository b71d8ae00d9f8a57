// SPDX-License-Identifier: MIT
#include "lib/log/recorder/stopped_columns_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace faultline {
namespace {

struct GroupWords {
  const char* code;
  const char* what;
};

GroupWords words_of(ColumnGroup group, bool is_zero) {
  switch (group) {
    case ColumnGroup::positions:
      return {"positions_stopped",
              "the positions of all joints keep every digit though their velocities say that they move"};
    case ColumnGroup::velocities:
      return {"velocities_stopped", is_zero
                                        ? "the velocities of all joints are zero though their positions move"
                                        : "the velocities of all joints keep every digit though their "
                                          "positions do not move so"};
    case ColumnGroup::torques:
      break;
  }
  return {"torques_stopped",
          is_zero ? "the torques of all joints are zero though the joints speed up and slow down"
                  : "the torques of all joints keep every digit though the joints speed up "
                    "and slow down"};
}

JointSignals& signals_of_group(Log& rows, ColumnGroup group) {
  if (group == ColumnGroup::positions) return rows.q;
  return group == ColumnGroup::velocities ? rows.dq : rows.tau;
}

}  // namespace

void StoppedColumnsSource::rewind() {
  source_->rewind();
  columns_ = {};
  holds_ = {};
  rows_ = {};
  judged_ = 0;
  handed_out_ = 0;
  at_end_ = false;
  found_ = {};
}

const Issues& StoppedColumnsSource::issues() const {
  issues_ = source_->issues();
  issues_.merge(found_);
  return issues_;
}

bool StoppedColumnsSource::next(Log& segment) {
  for (Log incoming; settled() == 0;) {
    if (at_end_) return false;
    at_end_ = !source_->next(incoming);
    if (at_end_) continue;
    if (rows_.rows() == 0)
      std::swap(rows_, incoming);
    else
      append(rows_, incoming);
    judge_rows();
  }
  const int done = settled();
  const std::int64_t first = rows_.first_row;
  if (done == rows_.rows()) {
    segment = std::exchange(rows_, {});
  } else {
    segment = slice(rows_, 0, done);
    rows_ = slice(rows_, done, rows_.rows());
    rows_.first_row = first + done;
  }
  segment.first_row = first;
  handed_out_ += done;
  judged_ -= done;
  return true;
}

void StoppedColumnsSource::judge_rows() {
  for (; judged_ < rows_.rows(); ++judged_) {
    holds_ = columns_.take(rows_, judged_, handed_out_ + judged_);
    for (int group = 0; group < kColumnGroups; ++group)
      if (holds_[group].stopped) empty_held(static_cast<ColumnGroup>(group), holds_[group], judged_);
  }
}

/// The first row of a hold was measured, unless it is zero as well.
void StoppedColumnsSource::empty_held(ColumnGroup group, const ColumnHold& hold, int up_to) {
  JointSignals& signals = signals_of_group(rows_, group);
  const std::int64_t first = hold.first_row + (hold.is_zero ? 0 : 1) - handed_out_;
  const GroupWords words = words_of(group, hold.is_zero);
  for (int row = static_cast<int>(std::max<std::int64_t>(first, 0)); row <= up_to; ++row) {
    if (std::isnan(signals.front()[row])) continue;
    const std::int64_t number = rows_.first_row + row + 1;
    found_.add({words.code, "", Severity::warning,
                fmt::format("row {}: {}: the recorder did not measure them; such values are taken as missing",
                            number, words.what),
                number, rows_.time[row], 1});
    for (std::vector<double>& joint : signals) joint[row] = std::nan("");
  }
}

/// Rows that nothing will change any more.
int StoppedColumnsSource::settled() const {
  if (at_end_) return rows_.rows();
  std::int64_t least = judged_;
  for (const ColumnHold& hold : holds_)
    if (!hold.decided && hold.repeats > 0) least = std::min(least, hold.first_row - handed_out_);
  return static_cast<int>(std::max<std::int64_t>(least, 0));
}

}  // namespace faultline
