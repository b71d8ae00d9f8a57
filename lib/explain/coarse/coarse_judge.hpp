// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>

#include "lib/core/joint.hpp"
#include "lib/explain/coarse/coarse_log.hpp"
#include "lib/explain/coarse/fault_directions.hpp"
#include "lib/fault/fault_kind.hpp"

namespace faultline {

/// A hypothesis about a log at a coarse rate. FaultKind::none is the healthy robot.
struct CoarseGuess {
  FaultKind kind = FaultKind::none;
  Joint joint{};
  double onset_s = 1e9;
  double duration_s = 0.0;        ///< 0: to the end of the log
  Eigen::VectorXd start{};        ///< sizes to begin with; empty: none
  bool velocity_is_true = false;  ///< of a drift, see FaultClaim
};

/// Returns the guess that a claim begins with.
CoarseGuess guess_of(const FaultClaim& claim);

struct CoarseJudging {
  int rounds = 1;                ///< of integration and regression in turn; the first uses known steps
  bool move_onset = false;       ///< the onset is a further unknown
  double tolerated_share = 0.0;  ///< share of each state and torque that is tolerated as an error
  /// Steps of a guess of the same kind and joint, for the first round; null: those of the healthy robot, for
  /// intervals without the fault or if the guess has no size to begin with.
  std::shared_ptr<const CoarseSteps> known{};
};

/// Explains the log by a guess in rounds, each integrated and linearised about the trajectory that the one
/// before implies. Returns the best round, with its price subtracted; empty if the guess cannot be
/// integrated.
std::optional<CoarseExplanation> judge_coarse(const CoarseLog& log, const CoarseGuess& guess,
                                              const CoarseJudging& how);

/// Returns the variance to add to each measurement (2 joints), and the standard deviation of the unknown
/// force in each interval (joints x intervals), if errors of a share `tolerated_share` of each joint's range,
/// top speed and torque are tolerated. The force of an end stop is large.
Eigen::VectorXd tolerated_variance(const OneStepModel& model, double tolerated_share);
Eigen::MatrixXd tolerated_force(const CoarseLog& log, double tolerated_share);

}  // namespace faultline
