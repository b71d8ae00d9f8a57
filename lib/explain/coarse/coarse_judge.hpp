// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "lib/explain/coarse/coarse_log.hpp"
#include "lib/fault/fault_kind.hpp"

namespace faultline {

/// A hypothesis about a log at a coarse rate. FaultKind::none is the healthy robot.
struct CoarseGuess {
  FaultKind kind = FaultKind::none;
  int joint = 0;  ///< from 1
  double onset_s = 1e9;
  double duration_s = 0.0;  ///< 0: to the end of the log
  Eigen::VectorXd start;    ///< sizes to begin with; empty: none
};

/// Directions of a kind's sizes in the numbers that move the robot, with the prior standard deviation of the
/// sizes. Sizes: share of the torque lost; viscous and Coulomb friction added; kg at the tip; force on each
/// joint; empty for kinds that move nothing.
struct FaultDirections {
  Eigen::MatrixXd direction;  ///< numbers x sizes
  Eigen::VectorXd std;
};

FaultDirections fault_directions(const OneStepModel& model, FaultKind kind, int joint);
/// Prior standard deviation of a false position (rad or m) and of a drift (rad/s or m/s).
double usual_reading_error(const OneStepModel& model, int joint);

/// The log explained by a guess, integrated and linearised about the trajectory that it implies, `rounds`
/// times in turn; the best round counts. With `move_onset` the onset is a further unknown.
CoarseExplanation judge_coarse(const CoarseLog& log, const CoarseGuess& guess, int rounds,
                               bool move_onset = false);

}  // namespace faultline
