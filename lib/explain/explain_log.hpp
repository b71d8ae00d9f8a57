// SPDX-License-Identifier: MIT
#pragma once

#include <variant>
#include <vector>

#include "lib/balance/balance_model.hpp"
#include "lib/balance/one_step/one_step_model.hpp"
#include "lib/balance/uniform_log.hpp"
#include "lib/explain/day_effects.hpp"
#include "lib/explain/decide_log.hpp"
#include "lib/explain/signal_stretch.hpp"

namespace faultline {

/// A robot as its logs show it: from 50 Hz on by rows of the torque balance, below by one-step predictions.
using RobotRows = std::variant<BalanceModel, OneStepModel>;

/// What explains the logs of a robot: the robot, and the evidence that a fault needs.
struct ExplainModel {
  RobotRows robot;
  EvidenceLimits limits;
  /// Of a log that is explained at once, s: about that of the healthy logs which the limits come from, since
  /// what a model lacks gives evidence in proportion to the rows.
  double window_s = kLongestWindow_s;

  static constexpr double kShortestWindow_s = 20.0, kLongestWindow_s = 60.0;  ///< bounds of window_s
};

/// The log as the rows of the robot take it: means of so many samples as the healthy logs were averaged over.
UniformLog averaged_as(const UniformLog& log, const RobotRows& robot);

/// What the whole of a log says.
struct ExplainedLog {
  std::vector<ExplainedFault> faults{};  ///< by onset
  /// Stretches that begin in the log, with the fault that explains each; without those that answer another
  /// fault.
  std::vector<JudgedStretch> stretches{};
  std::vector<FaultClaim> followed{};  ///< those that lasted when the log began, in the order given
  std::vector<DayEffect> day{};        ///< effects of the day beside the faults
  std::vector<double> loudness{};      ///< by joint: the noise of its rows, times that of the healthy logs
  double judged_s = 0.0;               ///< of the log, by rows that count
};

/// Whether a log is long enough to say anything.
bool can_explain(const UniformLog& log, const RobotRows& robot);

/// Explains a log for which can_explain() is true. `lasting` are faults that an earlier part of the log has
/// shown and that last when this one begins: they are not searched for again, only for their ends. `signals`
/// are the stretches in which other signals of the log contradict each other: they are judged in one score
/// with the torque balance, and faults are searched for beside them.
ExplainedLog explain_whole_log(const UniformLog& log, const ExplainModel& model,
                               const std::vector<FaultClaim>& lasting = {},
                               const SignalStretches& signals = {});

/// What a healthy log says, for evidence_limits(); nothing where the robot cannot be followed through it.
LogExplanation explain_healthy(const UniformLog& log, const RobotRows& robot);

}  // namespace faultline
