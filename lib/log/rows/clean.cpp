// SPDX-License-Identifier: MIT
#include "lib/log/rows/clean.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "lib/log/log_channels.hpp"
#include "lib/log/rows/keep_rows.hpp"

namespace faultline {
namespace {

/// A step this many times the one before may be a damaged time stamp.
constexpr double kLeap = 20.0;

bool is_plausible(double value) { return std::abs(value) <= kImplausible; }

/// Why row i cannot stay, or null.
const char* time_fault(const std::vector<double>& time, std::size_t i, const CleanState& state) {
  const double t = time[i];
  if (std::isnan(t)) return "time_missing";
  if (!is_plausible(t)) return "time_implausible";
  if (t == state.last_time) return "time_repeated";
  if (t < state.last_time) return "time_backward";
  return nullptr;
}

bool leaps(double t, const CleanState& state) {
  return state.last_step > 0.0 && t - state.last_time > kLeap * state.last_step;
}

bool next_is_between(const std::vector<double>& time, std::size_t i, const CleanState& state) {
  return i + 1 < time.size() && time[i + 1] > state.last_time && time[i + 1] < time[i];
}

/// Whether the clock may have restarted at this row, which depends on the row after it.
bool goes_far_back(double t, const CleanState& state) {
  return state.last_step > 0.0 && state.last_time - t > kLeap * state.last_step &&
         t < 0.5 * (state.first_time + state.last_time);
}

bool next_goes_on(const std::vector<double>& time, std::size_t i, const CleanState& state) {
  return i + 1 < time.size() && time[i + 1] > time[i] && time[i + 1] - time[i] <= kLeap * state.last_step;
}

void begin_run(std::int64_t row, double t, CleanState& state, Issues& issues) {
  issues.add(
      {"clock_restart", "t", Severity::warning,
       fmt::format("row {}: the clock goes back from {} to {} s and on from there: run {} begins, and run "
                   "{} is read. To read another: --run N",
                   row, state.last_time, t, state.run + 1, state.wanted_run),
       row, t, 1});
  state = {.wanted_run = state.wanted_run, .run = state.run + 1};
}

void report(Issues& issues, const char* code, std::int64_t row, double t, const CleanState& state) {
  std::string what = fmt::format("row {}: ", row);
  const std::string code_name = code;
  if (code_name == "time_missing") what += "has no time";
  if (code_name == "time_implausible") what += fmt::format("time {} s cannot be", t);
  if (code_name == "time_repeated") what += fmt::format("repeats the time {} s", t);
  if (code_name == "time_backward")
    what += fmt::format("time {} s is before {} s of an earlier row", t, state.last_time);
  if (code_name == "other_run") what += fmt::format("belongs to run {}", state.run);
  if (code_name == "time_leap") what += fmt::format("time {} s is ahead of the row after it", t);
  issues.add({code, "t", Severity::warning, what + "; the row was left out", row, t, 1, 1});
}

/// A row in order becomes the one before the next.
void pass(double t, CleanState& state) {
  if (state.last_time > -1e300)
    state.last_step = t - state.last_time;
  else
    state.first_time = t;
  state.last_time = t;
}

struct JudgedRows {
  std::vector<int> kept;  ///< by index
  bool held = false;      ///< the last row waits for the next segment
};

JudgedRows judge(const std::vector<double>& time, std::int64_t first_row, bool at_end, CleanState& state,
                 Issues& issues) {
  JudgedRows rows;
  rows.kept.reserve(time.size());
  for (std::size_t i = 0; i < time.size(); ++i) {
    const char* fault = time_fault(time, i, state);
    const std::int64_t row = first_row + static_cast<std::int64_t>(i) + 1;
    if (fault && goes_far_back(time[i], state)) {
      rows.held = i + 1 == time.size() && !at_end;
      if (rows.held) return rows;
      if (next_goes_on(time, i, state)) {
        begin_run(row, time[i], state, issues);
        fault = nullptr;
      }
    }
    if (!fault && leaps(time[i], state)) {
      rows.held = i + 1 == time.size() && !at_end;
      if (rows.held) return rows;
      if (next_is_between(time, i, state)) fault = "time_leap";
    }
    if (!fault) pass(time[i], state);
    if (!fault && state.run != state.wanted_run) fault = "other_run";
    if (fault)
      report(issues, fault, row, time[i], state);
    else
      rows.kept.push_back(static_cast<int>(i));
  }
  return rows;
}

void blank_implausible(std::vector<double>& values, Channel channel, const std::vector<double>& time,
                       std::int64_t first_row, Issues& issues) {
  bool fine = true;
  for (const double value : values) fine &= !(std::abs(value) > kImplausible);
  if (fine) return;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!(std::abs(values[i]) > kImplausible)) continue;
    const std::int64_t row = first_row + static_cast<std::int64_t>(i) + 1;
    issues.add(
        {"value_implausible", to_string(channel), Severity::warning,
         fmt::format("row {}: {} = {} cannot be; taken as missing", row, to_string(channel), values[i]), row,
         time[i]});
    values[i] = std::nan("");
  }
}

void keep_log_rows(Log& log, const std::vector<int>& kept) {
  for_each_joint_channel(log, [&](std::vector<double>& values, Channel) { keep_rows(values, kept); });
  for (ExtraChannel& extra : log.extra) keep_rows(extra.values, kept);
  keep_rows(log.time, kept);
}

/// The usual case: every time is finite and after the one before, and none leaps.
bool all_in_order(const std::vector<double>& time, CleanState& state) {
  if (state.run != state.wanted_run) return false;
  CleanState after = state;
  for (const double t : time) {
    if (!(t > after.last_time) || !(t <= kImplausible) || !(t >= -kImplausible) || leaps(t, after))
      return false;
    pass(t, after);
  }
  state = after;
  return true;
}

}  // namespace

Log clean(Log& segment, std::int64_t first_row, bool at_end, CleanState& state, Issues& issues) {
  JudgedRows judged;
  const bool in_order = all_in_order(segment.time, state);
  if (!in_order) judged = judge(segment.time, first_row, at_end, state, issues);
  Log waiting;
  const int rows = segment.rows();
  if (judged.held) {
    waiting = slice(segment, rows - 1, rows);
    resize_like(segment, segment, rows - 1);
  }
  for_each_joint_channel(segment, [&](std::vector<double>& values, Channel channel) {
    blank_implausible(values, channel, segment.time, first_row, issues);
  });
  if (!in_order && static_cast<int>(judged.kept.size()) < segment.rows()) keep_log_rows(segment, judged.kept);
  return waiting;
}

}  // namespace faultline
