// SPDX-License-Identifier: MIT
#include "apps/work/stop_moment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "formats/csv/clock_text.hpp"
#include "lib/core/error.hpp"
#include "lib/core/number_text.hpp"
#include "lib/core/text.hpp"
#include "lib/log/column_matching.hpp"
#include "lib/log/log_source.hpp"
#include "lib/log/mapped_source.hpp"

namespace faultline {
namespace {

constexpr std::size_t kListedColumns = 12;  // names of columns in a message, at most

std::string names_of(const std::vector<RawColumn>& columns) {
  std::string names;
  for (std::size_t i = 0; i < std::min(columns.size(), kListedColumns); ++i)
    names += (i == 0 ? "" : ", ") + shortened(columns[i].name, kLongestName);
  return columns.size() > kListedColumns ? names + ", .." : names;
}

/// Finds the first change of a column, value by value.
class FlagCourse {
 public:
  /// Whether the flag changes with this value: from 0 to another number, or from or to a text. A number that
  /// falls to 0 is no change, since most flags are 0 in normal operation.
  bool changes_with(double value) {
    const bool is_text = is_text_code(value);
    if (std::isnan(value)) {
      missing_ = true;
      return false;
    }
    bool changes = false;
    if (std::isnan(last_))
      changes = is_text && missing_;  // events are written only into the rows in which they happen
    else if (is_text || is_text_code(last_))
      changes = value != last_;
    else
      changes = last_ == 0.0 && value != 0.0;
    last_ = value;
    return changes;
  }

 private:
  double last_ = kNan;
  bool missing_ = false;
};

}  // namespace

double moment_of(const std::string& text, const std::string& option) {
  double value = 0.0;
  const char* const end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, value);
  if (read.ec == std::errc() && read.ptr == end && std::isfinite(value)) return value;
  if (const auto clock = read_clock(text, true);
      clock && clock->kind != ClockKind::date && clock->order != DateOrder::either)
    return clock->seconds;
  throw Error(
      ErrorCode::usage, option,
      fmt::format("\"{}\" is no moment; give seconds in the time of the log, as its report shows them, or "
                  "a date with a time, such as 2026-11-24T08:15:30.2Z, or a time of day",
                  shortened(text, kLongestName)));
}

StopLog stop_log(const std::string& path, const LogSelection& parts, const RecordingChoice& choice) {
  return {path, parts.run, [=] { return open_parts(path, parts, choice); }};
}

std::optional<double> first_change_of(const StopLog& log, const Robot& robot, const std::string& column) {
  std::unique_ptr<RawReader> reader = log.open();
  const std::vector<RawColumn> columns = reader->columns();
  const auto found = std::find_if(columns.begin(), columns.end(),
                                  [&](const RawColumn& each) { return each.name == column; });
  if (found == columns.end())
    throw Error(ErrorCode::usage, log.name,
                fmt::format("has no column \"{}\" for the stop of the machine; its columns are: {}",
                            shortened(column, kLongestName), names_of(columns)));
  reader->code_texts(static_cast<int>(found - columns.begin()));
  MappedSourceOptions options;
  options.columns = robot.log.columns;
  options.run = log.run;
  MappedSource source(std::move(reader), options);
  FlagCourse flag;
  for (Log segment; source.next(segment);) {
    const auto extra = std::find_if(segment.extra.begin(), segment.extra.end(),
                                    [&](const ExtraChannel& each) { return each.name == column; });
    if (extra == segment.extra.end())
      throw Error(ErrorCode::usage, log.name,
                  fmt::format("uses column \"{}\" as a channel of the log, so that it cannot be the stop of "
                              "the machine; name another column",
                              shortened(column, kLongestName)));
    for (int row = 0; row < segment.rows(); ++row)
      if (flag.changes_with(extra->values[row])) return segment.time[row];
  }
  return std::nullopt;
}

std::optional<StopQuestion> stop_question(const StopLog& log, const Robot& robot, const std::string& moment,
                                          const std::string& column) {
  if (!moment.empty()) return StopQuestion{moment_of(moment, "--at"), ""};
  const auto own = robot.log.columns.find(kStopChannel);
  const std::string name = column.empty() && own != robot.log.columns.end() ? own->second.name : column;
  if (name.empty()) return std::nullopt;
  std::optional<double> time_s;
  try {
    time_s = first_change_of(log, robot, name);
  } catch (const Error& error) {  // logs of a robot need not have the column that its file names
    if (!column.empty() || error.code() != ErrorCode::usage) throw;
  }
  if (time_s) return StopQuestion{*time_s, name};
  if (column.empty()) return std::nullopt;
  throw Error(ErrorCode::usage, log.name,
              fmt::format("column \"{}\" never rises from 0 and never changes its text, so that there is no "
                          "stop to ask about; give the moment with --at",
                          shortened(column, kLongestName)));
}

}  // namespace faultline
