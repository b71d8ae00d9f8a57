// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <vector>

namespace faultline {

/// A part of a log between two restarts of its clock. If several runs are read as one log, each follows the
/// one before after a gap: its times are those of its own clock plus an offset.
struct LogRun {
  int run = 1;                 ///< number of the run, from 1
  std::int64_t first_row = 0;  ///< first data row of the file, from 1
  std::int64_t rows = 0;       ///< rows with a usable time
  double start_s = 0.0;        ///< first and last time, as in the segments
  double end_s = 0.0;
  double clock_offset_s = 0.0;  ///< time in the log minus time of the run's own clock
  bool is_read = true;          ///< false if another run was requested
};

/// Value of a run option: all runs are read as one log.
inline constexpr int kEveryRun = 0;

/// Returns the run as a JSON object, the same in reports of every kind.
nlohmann::ordered_json log_run_json(const LogRun& run);

/// Number of time steps whose median is the sample period.
inline constexpr int kPeriodSteps = 4096;

/// A step of time longer than the others.
struct TimeGap {
  std::int64_t row = 0;  ///< row before the gap, from 1
  double start_s = 0.0;
  double length_s = 0.0;
};
/// Most gaps in the list; later ones are only counted.
inline constexpr std::size_t kListedGaps = 1000;

/// Sampling of a log, from its times in order.
struct TimeAxis {
  double period_s = std::numeric_limits<double>::quiet_NaN();  ///< median step; NaN while unknown
  double start_s = std::numeric_limits<double>::quiet_NaN();
  double end_s = std::numeric_limits<double>::quiet_NaN();
  std::int64_t rows = 0;
  std::int64_t gaps = 0;  ///< steps longer than three periods
  double longest_gap_s = 0.0;
  double in_gaps_s = 0.0;              ///< time inside all gaps
  std::int64_t uneven_steps = 0;       ///< other steps that differ by more than a fifth of a period
  double jitter_s = 0.0;               ///< rms deviation of steps from the period, without gaps
  double largest_jitter_s = 0.0;       ///< largest deviation, without gaps
  std::vector<TimeGap> listed_gaps{};  ///< the first kListedGaps
};

/// Follows the times of a log segment by segment; the result does not depend on the segments.
class TimeAxisPass {
 public:
  void add(const std::vector<double>& time);
  /// Returns the result of the times so far.
  TimeAxis result() const;

 private:
  void settle_period();
  void judge_step(double before, double now);

  TimeAxis axis_;
  std::vector<double> head_;  ///< first times, until there are enough to estimate the period
  std::int64_t judged_ = 0;   ///< rows before the step to be judged next
  double squares_ = 0.0;
};

/// Returns the axis without those listed gaps that lie between two runs, as no rows are missing there.
TimeAxis without_run_breaks(TimeAxis axis, const std::vector<LogRun>& runs);

/// Returns the median of the steps between increasing times; NaN for fewer than two times.
double median_step(std::span<const double> time);

/// Returns the longest time, s, for which a joint of a healthy log may not be judged: half a second, and at
/// least ten samples. A lasting fault shows as soon as the joint is judged again; a shorter one, such as a
/// touch, moves no robot far. Alarms take some ten samples, too (docs/how-it-works.md).
inline double judged_moment_s(double sample_period_s) {
  constexpr double kMoment_s = 0.5, kMomentRows = 10.0;
  return std::max(kMoment_s, kMomentRows * sample_period_s);
}

/// The same at the end of a log, or of a run, after which the joint is not judged again: ten samples.
inline double judged_moment_at_end_s(double sample_period_s) {
  constexpr double kMomentRows = 10.0;
  return kMomentRows * sample_period_s;
}

/// Returns the length, s, of a window of ten moments. Interruptions that are each shorter than a moment hide
/// a fault as well if they add up to more than kLeastUnjudgedShare of a window.
inline double judged_window_s(double sample_period_s) {
  constexpr double kMoments = 10.0;
  return kMoments * judged_moment_s(sample_period_s);
}

inline constexpr double kLeastUnjudgedShare = 0.25;

}  // namespace faultline
