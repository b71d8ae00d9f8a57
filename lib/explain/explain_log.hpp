// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "lib/balance/balance_model.hpp"
#include "lib/balance/one_step/one_step_model.hpp"
#include "lib/balance/uniform_log.hpp"
#include "lib/explain/day/day_effects.hpp"
#include "lib/explain/decide_log.hpp"
#include "lib/explain/signal_stretch.hpp"

namespace faultline {

/// Model of a robot: by torque-balance rows for logs of 50 Hz and more, by one-step predictions below.
using RobotRows = std::variant<BalanceModel, OneStepModel>;

/// Model that explains the logs of a robot: the robot, and the limits for its faults.
struct ExplainModel {
  RobotRows robot;
  EvidenceLimits limits;
  /// Length of a log that is explained at once, s: about that of the healthy logs from which the limits come,
  /// since errors of the model give evidence in proportion to the rows.
  double window_s = kLongestWindow_s;

  static constexpr double kShortestWindow_s = 20.0, kLongestWindow_s = 60.0;  ///< bounds of window_s
};

/// Returns the log for the rows of the robot: means of as many samples as in the healthy logs.
UniformLog averaged_as(const UniformLog& log, const RobotRows& robot);

/// Explanation of a whole log.
struct ExplainedLog {
  std::vector<ExplainedFault> faults{};  ///< by onset
  /// Stretches that begin in the log, with the fault that explains each; without those that are the response
  /// of a controller to another fault.
  std::vector<JudgedStretch> stretches{};
  std::vector<FaultClaim> followed{};  ///< faults that lasted when the log began, in the order given
  std::vector<DayEffect> day{};        ///< effects of the day beside the faults
  std::vector<double> loudness{};      ///< by joint: the noise of its rows, times that of the healthy logs
  EvidenceScore score{};               ///< beside the faults that lasted when the log began
  double judged_s = 0.0;               ///< of the log that was judged, by rows with weight
};

/// Returns whether a log is long enough to be explained.
bool can_explain(const UniformLog& log, const RobotRows& robot);

/// Explains a log for which can_explain() is true. `lasting` are faults that an earlier part of the log has
/// shown and that last when this one begins: only their ends are searched. `signals` are the stretches in
/// which other signals of the log contradict each other: they are judged in one score with the torque
/// balance, and faults are searched beside them.
ExplainedLog explain_whole_log(const UniformLog& log, const ExplainModel& model,
                               const std::vector<FaultClaim>& lasting = {},
                               const SignalStretches& signals = {});

/// Explains a healthy log, for evidence_limits(); empty if too little of it can be integrated.
LogExplanation explain_healthy(const UniformLog& log, const RobotRows& robot);

/// Returns the fault of a log that is known to begin at `onset_s` and to end at `end_s` (kNeverEnds for one
/// that lasts): judges every kind at every joint with these times, without a search. Empty if no kind exceeds
/// its limit. For logs with known truth, from which networks and cases learn.
std::optional<ExplainedFault> explain_at(const UniformLog& log, const ExplainModel& model, double onset_s,
                                         double end_s);

}  // namespace faultline
