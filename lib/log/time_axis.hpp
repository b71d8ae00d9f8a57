// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "lib/log/log_run.hpp"

namespace faultline {

/// Steps of time from which the sample period is taken (their median).
inline constexpr int kPeriodSteps = 4096;

/// A step of time longer than the others.
struct TimeGap {
  std::int64_t row = 0;  ///< the row before it, from 1
  double start_s = 0.0;
  double length_s = 0.0;
};
/// Gaps that are listed; later ones are only counted.
inline constexpr std::size_t kListedGaps = 1000;

/// What is known of a log's sampling, from its times in order.
struct TimeAxis {
  double period_s = std::numeric_limits<double>::quiet_NaN();  ///< median step; NaN while unknown
  double start_s = std::numeric_limits<double>::quiet_NaN();
  double end_s = std::numeric_limits<double>::quiet_NaN();
  std::int64_t rows = 0;
  std::int64_t gaps = 0;           ///< steps longer than gap_factor periods
  std::int64_t first_gap_row = 0;  ///< row before it, from 1
  double first_gap_s = 0.0;        ///< time before it
  double longest_gap_s = 0.0;
  double in_gaps_s = 0.0;              ///< time inside all gaps
  std::int64_t uneven_steps = 0;       ///< other steps more than jitter_share of a period off
  double jitter_s = 0.0;               ///< rms deviation of steps from the period, gaps left out
  double largest_jitter_s = 0.0;       ///< largest deviation, gaps left out
  std::vector<TimeGap> listed_gaps{};  ///< the first kListedGaps
};

struct TimeAxisOptions {
  double gap_factor = 3.0;    ///< a step longer than so many periods is a gap
  double jitter_share = 0.2;  ///< a step this share of a period off is uneven
};

/// Follows the times of a log segment by segment; the result does not depend on the segments.
class TimeAxisPass {
 public:
  explicit TimeAxisPass(const TimeAxisOptions& options = {}) : options_(options) {}
  void add(const std::vector<double>& time);
  /// What is known so far.
  TimeAxis result() const;

 private:
  void settle_period();
  void judge_step(double before, double now);

  TimeAxisOptions options_;
  TimeAxis axis_;
  std::vector<double> head_;  ///< first times, until there are enough to tell the period
  std::int64_t judged_ = 0;   ///< rows before the step to be judged next
  double squares_ = 0.0;
};

/// Without the gaps between runs among those that are listed: nothing is missing there.
TimeAxis without_run_breaks(TimeAxis axis, const std::vector<LogRun>& runs);

/// Median of the steps between increasing times, NaN for less than two.
double median_step(const std::vector<double>& time);

}  // namespace faultline
