// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "lib/diagnose/monitor/monitored_log.hpp"
#include "lib/explain/signal_stretch.hpp"
#include "lib/log/log.hpp"
#include "lib/log/time_axis.hpp"
#include "lib/model/model.hpp"
#include "lib/residual/residuals.hpp"

namespace faultline {

/// Length from the onset on over which the residuals of an episode are summed up.
inline constexpr double kEpisodeResiduals_s = 3.0;

/// Gathers the rows of a log in windows (ExplainModel::window_s) and explains each of them. Windows overlap,
/// so that an onset has rows before and behind it; a gap or a restart of the clock ends a window. A fault
/// that lasts is handed on to the next window. The result does not depend on segment borders, and memory does
/// not grow with the log.
class ExplainMonitor {
 public:
  /// The model outlives this. `signals` are the stretches of the log in which its other signals contradict
  /// each other, by onset.
  explicit ExplainMonitor(const Model& model, std::vector<SignalStretch> signals = {})
      : model_(model), unjudged_(signals.begin(), signals.end()) {}

  /// Takes the next rows with their residuals; `runs` are those known so far.
  void take(const Log& segment, Residuals residuals, const std::vector<LogRun>& runs);
  /// Ends the log, after the last segment.
  void finish();

  /// By onset.
  const std::vector<MonitoredEpisode>& episodes() const { return episodes_; }
  /// The stretches that are faults, by onset.
  const std::vector<JudgedStretch>& stretches() const { return stretches_; }
  /// Estimates of the effects of the day; empty if no window could be explained.
  std::vector<DayEffect> day() const;
  /// Of the window with the largest ratio.
  const EvidenceScore& score() const { return score_; }
  /// Share of the log whose rows count for the regression; 0 if no window could be explained.
  double judged_share() const { return read_s_ > 0.0 ? judged_s_ / read_s_ : 0.0; }
  /// By joint: noise level of the rows over that of the healthy logs, in the noisiest window.
  const std::vector<double>& noise_level() const { return noise_level_; }

 private:
  void explain_window(bool is_followed);
  ExplainedLog explained_window() const;
  SignalStretches signals_of_window() const;
  void report_stretches(const std::vector<JudgedStretch>& judged, double until_s);
  void keep_from(double time_s);
  void add_day(const std::vector<DayEffect>& day);
  std::vector<JointResidual> residuals_between(double from_s, double to_s) const;

  /// A fault that reaches into the next window.
  struct OngoingFault {
    FaultClaim claim;
    std::size_t episode = 0;

    /// Rows of an unknown fault that lasts would be silent, so the next window judges them anew.
    bool is_handed_on() const { return claim.kind != FaultKind::unknown || claim.end_s < kNeverEnds; }
  };

  std::vector<OngoingFault> follow(const std::vector<FaultClaim>& followed);
  void report(const ExplainedFault& fault, const std::vector<OngoingFault>& unfollowed);

  const Model& model_;
  Log window_;
  std::deque<Residuals> residuals_;  ///< of the window
  std::optional<double> decided_s_;  ///< time up to which the windows before have decided
  std::size_t run_ = 0;
  std::vector<OngoingFault> ongoing_;
  std::vector<MonitoredEpisode> episodes_;
  std::deque<SignalStretch> unjudged_;  ///< those that begin after decided_s_
  std::vector<JudgedStretch> stretches_;
  std::vector<DayEffect> day_;  ///< sums: value over variance, in `std` 1 over variance
  std::vector<double> noise_level_;
  EvidenceScore score_;
  double judged_s_ = 0.0, read_s_ = 0.0;  ///< over all windows
};

}  // namespace faultline
