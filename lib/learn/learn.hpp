// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "lib/cases/case_base.hpp"
#include "lib/core/progress.hpp"
#include "lib/identify/identify.hpp"
#include "lib/log/log_source.hpp"
#include "lib/model/model.hpp"
#include "lib/model/twin/twin_options.hpp"
#include "lib/residual/learn_residual.hpp"

namespace faultline {

/// A log with the fault that it is known to show.
struct LabelledLog {
  LogSource* log = nullptr;
  FaultLabel label;
  double onset_s = 0.0;
};

/// False alarms per hour for which the limits from healthy logs are meant.
inline constexpr double kUsualAlarmsPerHour = 0.01;

struct LearnOptions {
  IdentifyOptions identify{};
  ResidualOptions residual{};
  TwinOptions twin{};            ///< how faults are simulated
  int runs_per_label = 3;        ///< simulated to train the networks and fill the case base
  int validation_per_label = 1;  ///< simulated to validate the model, not used in training
  double alarms_per_hour =
      kUsualAlarmsPerHour;         ///< false alarms by chance, of the regression and of each relation
  int healthy_runs = 20;           ///< simulated for limits and networks, and as many to measure false alarms
  std::vector<FaultKind> kinds{};  ///< to simulate; empty = all that can be named
  bool keep_doubtful = false;      ///< a model with grave doubts is marked rather than refused
  int threads = 0;                 ///< 0 = one a core; changes no byte of the result
  std::uint64_t seed = 1;

  /// Throws Error(usage) naming the field, its value and its bound.
  void check() const;
};

struct Learned {
  Model model;
  CaseBase cases;
  Identification identification;
  LearnedResidual residual;
};

/// Learns one robot from its healthy logs: identify it, learn its fault-free motion, learn how its days
/// differ, simulate faults on the identified robot, train the networks and fill the case base with them (and
/// with the labelled logs, if any), and validate all that on further simulated runs. If no healthy log has a
/// torque, the model holds only how the joints follow their references (tracking_model()). Logs that the
/// others contradict are left out (consistent_robot()); Model::doubts lists the other doubts about the model.
/// Throws Error(input) when the logs do not suffice, or give a model with grave doubts.
Learned learn(std::span<LogSource* const> healthy, std::span<const LabelledLog> labelled, const Robot& robot,
              const LearnOptions& options = {}, const Progress& progress = {});

}  // namespace faultline
