// SPDX-License-Identifier: MIT
#include "formats/parts/partner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "formats/missing.hpp"

namespace faultline {
namespace {

constexpr int kPartnerRowsAtOnce = 4096;
/// Rows further apart than so many usual steps are not interpolated between.
constexpr double kWidestGap = 5.0;

}  // namespace

Partner::Partner(std::unique_ptr<RawReader> reader, std::optional<RawTime> time)
    : reader_(std::move(reader)), time_(time) {}

void Partner::rewind() {
  reader_->rewind();
  block_ = {};
  at_ = -1;
  ended_ = has_before_ = has_behind_ = false;
  step_s_ = 0.0;
  without_ = between_ = asked_ = passed_ = 0;
}

bool Partner::next_row() {
  if (++at_ < block_.rows) return true;
  at_ = 0;
  if (!ended_) ended_ = !reader_->next(block_, kPartnerRowsAtOnce);
  if (ended_) block_.rows = 0;
  return !ended_;
}

void Partner::give(std::int64_t number, double time_s, int row, const std::vector<double*>& values) {
  ++asked_;
  if (time_)
    give_by_time(time_s, row, values);
  else
    give_by_row(number, row, values);
}

void Partner::give_by_row(std::int64_t number, int row, const std::vector<double*>& values) {
  while (!ended_ && (block_.rows == 0 || block_.first_row + at_ < number)) next_row();
  const bool there = !ended_ && block_.first_row + at_ == number;
  without_ += !there;
  for (std::size_t c = 0; c < values.size(); ++c)
    if (values[c]) values[c][row] = there ? block_.columns[c][at_] : kNan;
}

void Partner::read_sample(Sample& sample) {
  sample.time_s = time_->at(block_, at_);
  sample.values.resize(block_.columns.size());
  for (std::size_t c = 0; c < block_.columns.size(); ++c) sample.values[c] = block_.columns[c][at_];
}

void Partner::read_rest() {
  if (time_) return;
  while (next_row()) ++passed_;
}

/// The next row whose time is behind that of the last one; others cannot be found by time.
bool Partner::advance() {
  if (has_behind_) {
    if (has_before_) step_s_ = behind_.time_s - before_.time_s;
    std::swap(before_, behind_);
    has_before_ = true;
  }
  has_behind_ = false;
  while (!has_behind_ && next_row()) {
    read_sample(behind_);
    has_behind_ = std::isfinite(behind_.time_s) && (!has_before_ || behind_.time_s > before_.time_s);
    passed_ += !has_behind_;
  }
  return has_behind_;
}

void Partner::give_by_time(double time_s, int row, const std::vector<double*>& values) {
  while ((!has_behind_ || behind_.time_s < time_s) && advance()) {
  }
  const bool exact = has_behind_ && behind_.time_s == time_s;
  const double gap_s = has_before_ && has_behind_ ? behind_.time_s - before_.time_s : 0.0;
  const bool near =
      gap_s > 0.0 && (step_s_ <= 0.0 || gap_s <= kWidestGap * step_s_) && before_.time_s < time_s;
  without_ += !exact && !near;
  between_ += !exact && near;
  const double share = exact ? 1.0 : (near ? (time_s - before_.time_s) / gap_s : kNan);
  for (std::size_t c = 0; c < values.size(); ++c) {
    if (!values[c]) continue;
    if (exact)
      values[c][row] = behind_.values[c];
    else
      values[c][row] = near ? before_.values[c] + share * (behind_.values[c] - before_.values[c]) : kNan;
  }
}

Issues Partner::issues() const {
  Issues issues = reader_->issues();
  const std::string& path = reader_->identity().path;
  if (without_ > 0)
    issues.add(
        {"join_without_partner", "", Severity::warning,
         fmt::format("{} of {} rows have no row of {} that belongs to them; its values are missing there",
                     without_, asked_, path)});
  if (passed_ > 0)
    issues.add({"join_rows_left", "", Severity::warning,
                fmt::format("{} rows of {} belong to no row of the log: {}", passed_, path,
                            time_ ? "their time runs back or is missing" : "they are behind its last one")});
  if (between_ > 0)
    issues.add({"join_interpolated", "", Severity::note,
                fmt::format("{} of {} rows lie between two of {}; its values were interpolated linearly",
                            between_, asked_, path)});
  return issues;
}

}  // namespace faultline
