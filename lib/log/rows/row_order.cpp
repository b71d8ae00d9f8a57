// SPDX-License-Identifier: MIT
#include "lib/log/rows/row_order.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <string>
#include <utility>

#include "lib/core/statistics.hpp"
#include "lib/log/log.hpp"
#include "lib/log/time_axis.hpp"

namespace faultline {
namespace {

constexpr double kLeap = 20.0;     // times the usual step: a stamp farther off may be damaged, or a restart
constexpr double kHole = 1.2;      // times the usual step: a row is missing between rows that far apart
constexpr double kCovered = 0.5;   // of the rows that a time span can hold: it has its rows already
constexpr int kFewRows = 8;        // of a run: fewer do not determine the usual step
constexpr int kStepsAround = 16;   // steps of which the usual step is the median
constexpr double kRunGap_s = 0.3;  // at least, between two runs,
constexpr double kRunGapSteps = 8.0;   // and so many steps: every stage treats that as a gap
constexpr double kPerSecond = 1000.0;  // shifts are whole milliseconds, so that times stay readable
constexpr double kDay_s = 86400.0, kHalfDay_s = 43200.0;
constexpr double kNearMidnight_s = 60.0;  // a time of day this close to midnight may pass it

/// Whether the clock continues from `time` to `next`, the time of the row after it.
bool goes_on(double time, double next, double usual) {
  return next > time && (usual <= 0.0 || next - time <= kLeap * usual);
}

std::string what_is_wrong(const std::string& code, double t, double newest) {
  if (code == "time_missing") return "has no time";
  if (code == "time_implausible") return fmt::format("time {} s is impossible", t);
  if (code == "time_repeated") return fmt::format("repeats the time {} s", t);
  if (code == "time_backward") return fmt::format("time {} s is before {} s of an earlier row", t, newest);
  return fmt::format("time {} s is ahead of the row after it", t);
}

constexpr auto is_before = [](double time, const auto& row) { return time < row.time; };

}  // namespace

void RowOrder::take(const Log& rows, std::int64_t first_row, Issues& issues) {
  forget_given();
  append(store_, rows);
  for (int i = 0; i < rows.rows(); ++i) numbers_.push_back(first_row + i + 1);
  for (; judged_ + 1 < store_.rows(); ++judged_)
    if (!is_simply_next(judged_)) judge(judged_, store_.time[judged_ + 1], issues);
}

void RowOrder::finish(Issues& issues) {
  for (; judged_ < store_.rows(); ++judged_) judge(judged_, std::nan(""), issues);
  end_run(issues);
  report_lost(issues);
  finished_ = true;
}

/// Takes a row that follows the newest one by at most kLeap times the last step and needs no further check;
/// returns false for any other row.
bool RowOrder::is_simply_next(int at) {
  const double own = store_.time[at] + kDay_s * midnights_, time = own + offset_, step = time - newest_;
  const bool is_usual = step > 0.0 && step <= kLeap * last_step_ && own <= kImplausible;
  if (!is_usual || !early_.empty() || !runs_.back().is_read) return false;
  last_step_ = step;
  newest_ = runs_.back().end_s = time;
  own_spans_.back().end_s = own;
  ++runs_.back().rows;
  lost_ = {};
  order_.push_back({time, own, at, numbers_[at]});
  return true;
}

/// Decides on a row; `next` is the recorded time of the row after it.
void RowOrder::judge(int at, double next, Issues& issues) {
  const double t = store_.time[at];
  const int days = placed(t) < t + clock_shift() ? midnights_ - 1 : midnights_;
  const double own = t + kDay_s * days;
  Row row{own + offset_, own, at, numbers_[at]};
  if (std::isnan(t)) return leave_out("time_missing", row, issues);
  if (std::abs(t) > kImplausible) return leave_out("time_implausible", row, issues);
  if (runs_.empty()) add_run({.run = 1, .first_row = row.number, .is_read = is_wanted(1)});
  if (row.time > newest_)
    take_ahead(row, placed(next), issues);
  else
    take_behind(row, placed(next), issues);
  if (!early_.empty()) give_up_early(row.number - kOrderWindowRows, issues);
}

double RowOrder::placed(double stamp) const {
  const double time = stamp + clock_shift();
  return midnights_ > 0 && time - newest_ > kHalfDay_s ? time - kDay_s : time;
}

void RowOrder::take_ahead(const Row& row, double next, Issues& issues) {
  const double step = row.time - newest_;
  const bool leaps = last_step_ > 0.0 && step > kLeap * last_step_ && step > kLeap * usual_step();
  if (leaps && next > newest_ && next < row.time)
    early_.push_back(row);
  else
    advance(row, issues);
}

/// Returns the place of a row that comes after later ones.
RowOrder::Behind RowOrder::behind(const Row& row) const {
  Behind out;
  const auto begin = order_.begin() + static_cast<std::ptrdiff_t>(run_begin_);
  const auto later = std::upper_bound(begin, order_.end(), row.time, is_before);
  const double usual = usual_step(), behind_s = newest_ - row.time;
  const auto rows_later = order_.end() - later;
  const bool is_first = later == begin, few = order_.size() - run_begin_ < kFewRows;
  out.later = later - order_.begin();
  out.is_repeated = !is_first && (later - 1)->time == row.time;
  out.is_same = out.is_repeated && is_same_row((later - 1)->at, row.at);
  out.is_far = usual > 0.0 && behind_s > kLeap * usual;
  const bool covered = is_first || static_cast<double>(rows_later) * usual >= kCovered * behind_s;
  const bool is_last = later == order_.end();  // the newest row was not kept
  const bool is_hole = few || is_first || is_last || later->time - (later - 1)->time >= kHole * usual;
  const bool is_in_run = runs_.size() < 2 || row.time > runs_[runs_.size() - 2].end_s;
  out.fits =
      !out.is_repeated && is_in_run && rows_later < kOrderWindowRows && is_hole && !(out.is_far && covered);
  return out;
}

void RowOrder::take_behind(const Row& row, double next, Issues& issues) {
  const Behind place_of_it = behind(row);
  if (place_of_it.is_same) return leave_out("time_repeated", row, issues);
  if (place_of_it.fits) {
    issues.add({"time_out_of_order", "t", Severity::note,
                fmt::format("row {}: time {} s comes after later ones; such rows were moved to their places, "
                            "up to {} rows back",
                            row.number, store_.time[row.at], kOrderWindowRows),
                row.number, store_.time[row.at], 1});
    return place(row, place_of_it.later, issues);
  }
  if (!place_of_it.is_far || !goes_on(row.time, next, usual_step()))
    return leave_out(row.time == newest_ ? "time_repeated" : "time_backward", row, issues);
  if (passes_midnight(row))
    pass_midnight(row, issues);
  else
    begin_run(row, issues);
}

bool RowOrder::passes_midnight(const Row& row) const {
  const double before = newest_ - clock_shift(), now = store_.time[row.at];
  return before < kDay_s && before >= kDay_s - kNearMidnight_s && now >= 0.0 && now < kNearMidnight_s;
}

void RowOrder::pass_midnight(Row row, Issues& issues) {
  issues.add(
      {"clock_midnight", "t", Severity::note,
       fmt::format("row {}: the time of day passes midnight; {} s are added to the times from there on",
                   row.number, kDay_s),
       row.number, store_.time[row.at], 1});
  ++midnights_;
  row.time += kDay_s;
  row.own += kDay_s;
  advance(row, issues);
}

void RowOrder::begin_run(Row row, Issues& issues) {
  const double gap_s = std::max(kRunGap_s, kRunGapSteps * usual_step());
  end_run(issues);
  const int run = static_cast<int>(runs_.size()) + 1;
  const double shift = std::ceil(kPerSecond * (newest_ - row.time + gap_s)) / kPerSecond;
  const double own = store_.time[row.at], days = std::round((row.own - own) / kDay_s);
  const double offset = offset_ + kDay_s * days + shift;
  const std::string reading =
      wanted_run_ == kEveryRun
          ? fmt::format("it is read after a gap, with {} s added to its times. To read only one run: --run N",
                        offset)
          : fmt::format("run {} is read. To read all of them, leave out --run", wanted_run_);
  issues.add(
      {"clock_restart", "t", Severity::warning,
       fmt::format("row {}: the clock goes back from {} to {} s and continues from there: run {} begins; {}",
                   row.number, newest_ - clock_shift(), own, run, reading),
       row.number, own, 1});
  offset_ = offset;
  midnights_ = 0;
  row = {own + offset_, own, row.at, row.number};
  add_run({.run = run,
           .first_row = row.number,
           .start_s = row.time,
           .clock_offset_s = offset_,
           .is_read = is_wanted(run)});
  run_begin_ = order_.size();
  last_step_ = 0.0;
  advance(row, issues);
}

void RowOrder::add_run(const LogRun& run) {
  runs_.push_back(run);
  own_spans_.emplace_back();
}

/// Leaves out rows that leapt ahead and were never reached: they are damaged.
void RowOrder::end_run(Issues& issues) { give_up_early(std::numeric_limits<std::int64_t>::max(), issues); }

void RowOrder::advance(const Row& row, Issues& issues) {
  if (order_.size() > run_begin_) last_step_ = row.time - newest_;
  newest_ = row.time;
  place(row, std::ssize(order_), issues);
  if (!early_.empty()) place_early(issues);
}

void RowOrder::place(const Row& row, std::ptrdiff_t where, Issues& issues) {
  LogRun& run = runs_.back();
  OwnSpan& own = own_spans_.back();
  if (run.rows == 0) {
    run.start_s = run.end_s = row.time;
    own = {row.own, row.own};
  }
  run.start_s = std::min(run.start_s, row.time);
  run.end_s = std::max(run.end_s, row.time);
  own = {std::min(own.start_s, row.own), std::max(own.end_s, row.own)};
  ++run.rows;
  lost_ = {};
  order_.insert(order_.begin() + where, row);
  if (run.is_read) return;
  issues.add({"other_run", "t", Severity::warning,
              fmt::format("row {}: belongs to run {}; the row was left out", row.number, run.run), row.number,
              store_.time[row.at], 1, 1});
}

/// Puts rows that leapt ahead and have now been reached in their places.
void RowOrder::place_early(Issues& issues) {
  const auto is_reached = [&](const Row& row) { return row.time <= newest_; };
  for (const Row& row : early_) {
    if (!is_reached(row)) continue;
    const auto later = std::upper_bound(order_.begin() + static_cast<std::ptrdiff_t>(run_begin_),
                                        order_.end(), row.time, is_before);
    if (later != order_.begin() && (later - 1)->time == row.time)
      leave_out("time_repeated", row, issues);
    else
      place(row, later - order_.begin(), issues);
  }
  std::erase_if(early_, is_reached);
}

void RowOrder::give_up_early(std::int64_t before, Issues& issues) {
  const auto is_old = [&](const Row& row) { return row.number < before; };
  for (const Row& row : early_)
    if (is_old(row)) leave_out("time_leap", row, issues);
  std::erase_if(early_, is_old);
}

void RowOrder::leave_out(const std::string& code, const Row& row, Issues& issues) {
  issues.add({code, "t", Severity::warning,
              fmt::format("row {}: {}; the row was left out", row.number,
                          what_is_wrong(code, store_.time[row.at], newest_ - clock_shift())),
              row.number, store_.time[row.at], 1, 1});
  if (code == "time_repeated") return;
  if (lost_.rows++ == 0) lost_.first = row.number;
  if (lost_.rows <= most_lost_.rows) return;
  lost_.step_s = usual_step();
  most_lost_ = lost_;
}

bool RowOrder::is_same_row(int a, int b) const {
  bool same = true;
  for_each_joint_channel(store_, [&](const std::vector<double>& values, Channel) {
    same = same && (values[a] == values[b] || (std::isnan(values[a]) && std::isnan(values[b])));
  });
  return same;
}

/// Returns the median of the latest steps of the present run; 0 before there is one.
double RowOrder::usual_step() const {
  const std::size_t rows = order_.size() - run_begin_;
  const std::size_t steps = std::min<std::size_t>(rows > 0 ? rows - 1 : 0, kStepsAround);
  if (steps == 0) return 0.0;
  std::vector<double> latest;
  for (std::size_t k = order_.size() - steps; k < order_.size(); ++k)
    latest.push_back(order_[k].time - order_[k - 1].time);
  return upper_median_of(latest);
}

void RowOrder::report_lost(Issues& issues) const {
  const double lost_s = static_cast<double>(most_lost_.rows) * most_lost_.step_s;
  if (lost_s <= judged_moment_s(most_lost_.step_s)) return;
  issues.add({"rows_not_judged", "t", Severity::severe,
              fmt::format("{} rows in succession from row {} on ({:.3g} s of them) have no usable time and "
                          "were left out; this part of the log is not judged",
                          most_lost_.rows, most_lost_.first, lost_s),
              most_lost_.first, std::nan(""), most_lost_.rows});
}

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

void blank_implausible(Log& segment, std::int64_t first_row, Issues& issues) {
  for_each_joint_channel(segment, [&](std::vector<double>& values, Channel channel) {
    bool fine = true;
    for (const double value : values) fine &= !(std::abs(value) > kImplausible);
    if (fine) return;
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (!(std::abs(values[i]) > kImplausible)) continue;
      const std::int64_t row = first_row + static_cast<std::int64_t>(i) + 1;
      issues.add({"value_implausible", to_string(channel), Severity::warning,
                  fmt::format("row {}: {} = {} is impossible; treated as missing", row, to_string(channel),
                              values[i]),
                  row, segment.time[i]});
      values[i] = std::nan("");
    }
  });
}

}  // namespace faultline
