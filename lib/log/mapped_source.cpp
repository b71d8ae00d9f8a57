// SPDX-License-Identifier: MIT
#include "lib/log/mapped_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <tuple>
#include <unordered_map>
#include <unordered_set>

#include "lib/core/error.hpp"
#include "lib/log/log.hpp"
#include "lib/log/time_axis.hpp"
#include "lib/log/units.hpp"

namespace faultline {
namespace {

constexpr int kHeldRows = 10;  // at least

/// Fills gaps with the latest value. A joint's signal without values for longer than a moment has ended: its
/// last value is no longer a measurement.
void hold(std::vector<double>& values, const std::vector<double>& time, bool is_measured, HeldValue& held) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isnan(values[i])) {
      held = {values[i], time[i], 0};
    } else if (!is_measured || ++held.rows <= kHeldRows || time[i] - held.since_s <= judged_moment_s(0.0)) {
      values[i] = held.value;
    }
  }
}

std::vector<int> rows_with_position(const Log& log) {
  std::vector<int> rows;
  for (int i = 0; i < log.rows(); ++i)
    if (std::any_of(log.q.begin(), log.q.end(), [&](const auto& joint) { return !std::isnan(joint[i]); }))
      rows.push_back(i);
  return rows;
}

}  // namespace

/// Fills each missing value of a segment whose rows hold only some of the signals with the latest one, a
/// joint signal for a moment only (judged_moment_s()), and removes the rows without any position.
void MappedSource::gather_sparse_rows(Log& segment) {
  const std::vector<int> rows = rows_with_position(segment);
  const auto lost = static_cast<std::int64_t>(segment.rows()) - std::ssize(rows);
  std::vector<std::vector<double>*> channels;
  for_each_joint_channel(segment, [&](std::vector<double>& values, Channel) { channels.push_back(&values); });
  const std::size_t joint_channels = channels.size();
  for (ExtraChannel& extra : segment.extra) channels.push_back(&extra.values);
  held_.resize(channels.size());
  for (std::size_t c = 0; c < channels.size(); ++c) {
    hold(*channels[c], segment.time, c < joint_channels, held_[c]);
    keep_rows(*channels[c], rows);
  }
  keep_rows(segment.time, rows);
  if (lost > 0)
    cleaning_issues_.add(
        {"row_of_other_signals", "", Severity::note,
         "rows without a position were left out; the values of other signals in them hold until the "
         "next value, or for a moment",
         0, std::numeric_limits<double>::quiet_NaN(), lost, lost});
}

MappedSource::MappedSource(std::unique_ptr<RawReader> reader, const MappedSourceOptions& options)
    : reader_(std::move(reader)), options_(options) {
  options_.segment_rows = std::max(options_.segment_rows, 1);
  order_ = RowOrder(options_.run);
  matching_ = match_columns(reader_->columns(), reader_->canonical() ? ColumnMap{} : options_.columns,
                            reader_->identity().path);
  identity_ = identity_of_columns();
  if (!options_.keep_extra) matching_.extra.clear();
  if (!options_.keep_partial_velocity) matching_ = without_partial_velocity(std::move(matching_));
  uses_.assign(reader_->columns().size(), 0);
  for (const ChannelSource& source : matching_.channels) {
    if (source.column >= 0) ++uses_[source.column];
    if (source.nanoseconds_column >= 0) ++uses_[source.nanoseconds_column];
  }
  for (const int column : matching_.extra) ++uses_[column];
  std::vector<bool> wanted;
  for (const int uses : uses_) wanted.push_back(uses > 0);
  reader_->want(wanted);
}

LogIdentity MappedSource::identity_of_columns() const {
  LogIdentity out = reader_->identity();
  for (const ChannelSource& source : matching_.channels)
    if (source.unit_is_stated) out.stated_units.push_back(to_string(source.channel));
  return out;
}

void MappedSource::rewind() {
  reader_->rewind();
  order_ = RowOrder(options_.run);
  identity_ = identity_of_columns();
  held_.clear();
  rows_kept_ = 0;
  at_end_ = false;
  cleaning_issues_ = {};
  gathered_ = false;
}

const Issues& MappedSource::issues() const {
  if (!gathered_) gather_issues();
  gathered_ = true;
  return issues_;
}

bool MappedSource::next(Log& segment) {
  gathered_ = false;
  for (;;) {
    while (!order_.give(segment, options_.segment_rows))
      if (!fill()) {
        refuse_no_rows();
        return false;
      }
    if (reader_->sparse()) gather_sparse_rows(segment);
    segment.first_row = rows_kept_;
    rows_kept_ += segment.rows();
    if (segment.rows() > 0) return true;
  }
}

void MappedSource::refuse_no_rows() const {
  if (rows_kept_ > 0) return;
  const LogIdentity& log = reader_->identity();
  if (log.rows_read == 0)
    throw Error(ErrorCode::input, log.path, "has a header but no data row; a log needs at least one");
  const auto runs = static_cast<int>(identity_.runs.size());
  if (runs > 0 && runs < options_.run)
    throw Error(ErrorCode::input, log.path,
                fmt::format("has no run {}: its clock restarts {} times", options_.run, runs - 1));
  throw Error(
      ErrorCode::input, log.path,
      fmt::format("none of its {} rows has a usable time (seconds as a number, increasing); first: {}",
                  log.rows_read, issues().empty() ? "" : issues().all().front().message));
}

/// Passes the next block of rows to the ordering; returns false if there is none.
bool MappedSource::fill() {
  if (at_end_) return false;
  at_end_ = !reader_->next(block_, options_.segment_rows);
  if (at_end_) {
    order_.finish(cleaning_issues_);
  } else {
    if (!epoch_found_) find_epoch();
    take_block(rows_);
    blank_implausible(rows_, block_.first_row, cleaning_issues_);
    order_.take(rows_, block_.first_row, cleaning_issues_);
  }
  // In place, since a reader ahead of the work changes it while the work looks at the runs.
  identity_.rows_read = reader_->identity().rows_read;
  identity_.sha256 = reader_->identity().sha256;
  identity_.runs = order_.runs();
  return true;
}

void MappedSource::take_block(Log& segment) {
  for (const Quantity quantity : kJointQuantities) {
    const bool present =
        std::any_of(matching_.channels.begin(), matching_.channels.end(),
                    [&](const ChannelSource& source) { return source.channel.quantity == quantity; });
    signals_of(segment, quantity).resize(present ? matching_.joints : 0);
  }
  for (const ChannelSource& source : matching_.channels) {
    const auto [quantity, joint] = source.channel;
    take(source, quantity == Quantity::time ? segment.time : signals_of(segment, quantity)[joint.index()]);
  }
  for_each_joint_channel(segment, [&](std::vector<double>& values, Channel channel) {
    const bool found = std::any_of(matching_.channels.begin(), matching_.channels.end(),
                                   [&](const ChannelSource& source) { return source.channel == channel; });
    if (!found) values.assign(block_.rows, std::nan(""));
  });
  segment.extra.resize(matching_.extra.size());
  for (std::size_t i = 0; i < matching_.extra.size(); ++i) {
    const RawColumn& column = reader_->columns()[matching_.extra[i]];
    segment.extra[i].name = column.name;
    segment.extra[i].unit = column.unit;
    segment.extra[i].values.swap(block_.columns[matching_.extra[i]]);
  }
}

/// Sets the unit of a time that can only count from 1970, and has none in the file, by its first row.
void MappedSource::find_epoch() {
  epoch_found_ = true;
  ChannelSource& time = matching_.channels.front();
  if (time.column < 0 || !time.unchanged() || block_.columns[time.column].empty()) return;
  const char* unit = epoch_unit(block_.columns[time.column].front());
  time.gain = *si_factor(unit);
}

void MappedSource::take(const ChannelSource& source, std::vector<double>& values) {
  if (source.column == kRowNumber) {
    values.resize(block_.rows);
    for (int i = 0; i < block_.rows; ++i)
      values[i] = source.gain * static_cast<double>(block_.first_row + i) + source.offset;
    return;
  }
  auto& raw = block_.columns[source.column];
  if (uses_[source.column] == 1)
    values.swap(raw);
  else
    values = raw;
  if (source.unchanged()) return;
  for (double& value : values) value = source.gain * value + source.offset;
  if (source.nanoseconds_column < 0) return;
  const auto& nanoseconds = block_.columns[source.nanoseconds_column];
  for (std::size_t i = 0; i < values.size(); ++i) values[i] += 1e-9 * nanoseconds[i];
}

/// Gathers all issues so far in the order of their first rows, for any size of the segments; those of
/// the reader get the names of the channels.
void MappedSource::gather_issues() const {
  const std::vector<RawColumn>& columns = reader_->columns();
  std::unordered_map<std::string_view, Channel> channel_of;
  std::unordered_set<std::string_view> extra;
  for (const ChannelSource& source : matching_.channels)
    if (source.column >= 0) channel_of.emplace(columns[source.column].name, source.channel);
  for (const int column : matching_.extra) extra.insert(columns[column].name);
  std::vector<Issue> all = matching_.issues.all();
  for (Issue issue : reader_->issues().all()) {
    if (const auto channel = channel_of.find(issue.channel); channel != channel_of.end())
      issue.channel = to_string(channel->second);
    else if (extra.count(issue.channel))
      issue.severity = Severity::note;
    all.push_back(issue);
  }
  for (const Issue& issue : cleaning_issues_.all()) all.push_back(issue);
  std::stable_sort(all.begin(), all.end(), [](const Issue& a, const Issue& b) {
    return std::tie(a.first_row, a.code, a.channel) < std::tie(b.first_row, b.code, b.channel);
  });
  issues_ = {};
  for (Issue& issue : all) issues_.add(std::move(issue));
}

}  // namespace faultline
