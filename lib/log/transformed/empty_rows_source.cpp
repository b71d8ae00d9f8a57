// SPDX-License-Identifier: MIT
#include "lib/log/transformed/empty_rows_source.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "lib/log/log.hpp"
#include "lib/log/time_axis.hpp"

namespace faultline {
namespace {

constexpr int kHeadRows = 64;         // rows whose median step is the period at first
constexpr double kForgetting = 0.02;  // weight of a new step in period and jitter: some 50 steps
constexpr double kLostRow = 1.6;      // periods: rows are missing in a longer step
constexpr double kOffGrid = 0.25;  // periods off a whole number: a step farther off is no sign of lost rows
constexpr double kRegular = 0.1;   // mean deviation of a step, in periods, below which a clock is regular
constexpr double kFewOffGrid =
    0.01;  // share of steps off the grid: with more, two periods may be a late stamp

/// Returns `log` with missing[k] empty rows before row k, at equal steps from the row before; `before_s` is
/// the time of the row before the first.
Log with_empty_rows(const Log& log, const std::vector<int>& missing, double before_s) {
  Log out;
  for_each_column(out, log, [&](std::vector<double>& values, const std::vector<double>& recorded) {
    for (std::size_t k = 0; k < recorded.size(); ++k) {
      values.insert(values.end(), missing[k], std::numeric_limits<double>::quiet_NaN());
      values.push_back(recorded[k]);
    }
  });
  for (std::size_t k = 0, at = 0; k < log.time.size(); ++k, ++at) {
    const double last_s = k > 0 ? log.time[k - 1] : before_s;
    const double step = (log.time[k] - last_s) / (missing[k] + 1);
    for (int m = 1; m <= missing[k]; ++m) out.time[at++] = last_s + m * step;
  }
  return out;
}

}  // namespace

/// Reads the first rows, for any segments of the source, and estimates the period; false without any.
bool InsertedRows::read_head(LogSource& source) {
  started_ = true;
  for (Log segment; head_.rows() < kHeadRows && source.next(segment);) append(head_, std::move(segment));
  const auto rows = std::min(head_.rows(), kHeadRows);
  period_s_ = median_step(std::span(head_.time).first(static_cast<std::size_t>(rows)));
  double deviations = 0.0;
  int steps = 0;
  for (int k = 1; k < rows; ++k) {
    const double periods = (head_.time[k] - head_.time[k - 1]) / period_s_;
    if (periods > kLostRow) continue;
    deviations += std::abs(periods - 1.0);
    ++steps;
  }
  jitter_ = steps > 0 ? deviations / steps : 1.0;
  return head_.rows() > 0;
}

void InsertedRows::follow_clock(double step) {
  const double periods = step / period_s_;
  off_grid_ += std::abs(periods - std::round(periods)) > kOffGrid;
  if (periods > kLostRow) return;
  jitter_ += kForgetting * (std::abs(periods - 1.0) - jitter_);
  period_s_ += kForgetting * (step - period_s_);
}

/// Returns the number of rows missing between the last one and this one.
int InsertedRows::missing_before(double time) {
  const double step = time - last_s_;
  const double periods = step / period_s_, whole = std::round(periods);
  const bool is_regular =
      jitter_ < kRegular && static_cast<double>(off_grid_) <= kFewOffGrid * static_cast<double>(rows_);
  const bool is_lost = rows_ > 0 && is_regular && periods > kLostRow &&
                       std::abs(periods - whole) < kOffGrid && whole <= kMostEmptyRows + 1;
  if (rows_ > 0) follow_clock(step);
  return is_lost ? static_cast<int>(whole) - 1 : 0;
}

bool InsertedRows::next(LogSource& source, Log& segment) {
  Log read;
  if (!started_) {
    if (!read_head(source)) return false;
    std::swap(read, head_);
  } else if (!source.next(read)) {
    return false;
  }
  const double before_s = last_s_;
  std::vector<int> missing(read.time.size());
  for (std::size_t k = 0; k < read.time.size(); ++k) {
    missing[k] = missing_before(read.time[k]);
    last_s_ = read.time[k];
    ++rows_;
  }
  const bool is_complete = std::all_of(missing.begin(), missing.end(), [](int rows) { return rows == 0; });
  segment = is_complete ? std::move(read) : with_empty_rows(read, missing, before_s);
  segment.first_row = given_;
  given_ += segment.rows();
  return true;
}

}  // namespace faultline
