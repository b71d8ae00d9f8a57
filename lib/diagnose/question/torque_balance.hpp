// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/identify/usual_motion.hpp"
#include "lib/log/log.hpp"
#include "lib/robot/robot.hpp"

namespace faultline {

inline constexpr int kExcerptRows = 4000;  ///< rows of a stretch that is tested at once
/// Misfit of a joint's torque up to which it is as the robot requires.
inline constexpr double kTorqueFits = 0.35;

/// The identified robot that a log is compared with, and its usual motion.
struct KnownRobot {
  const Robot& robot;
  const UsualMotion& usual;

  const Chain& chain() const { return robot.chain; }
  int joints() const { return robot.joints(); }
  double torque_phi() const { return robot.torque_phi.value_or(0.0); }
};

/// How the torque of one joint in a stretch of a log fits the known robot.
struct JointMatch {
  /// For each block of successive windows in which the joint moves, in the order of time: root mean square of
  /// logged minus required torque over the standard deviation of the torque. An offset and half to twice the
  /// friction are fitted first. In a block whose torque varies by less than a tenth of the largest healthy
  /// torque, relative to the mean torque and without an offset; a block in which that is small too is left
  /// out.
  std::vector<double> misfits;
  /// Measured velocity over the derivative of the position if they are one motion in two units; else 1.
  double velocity_factor = 1.0;
  /// Factor from required to logged torque, fitted to all windows with an offset; 0 if the torque varies too
  /// little.
  double torque_ratio = 0.0;
  double ratio_residual = 1.0;  ///< share of the logged torque's standard deviation that this factor leaves

  bool is_determined() const { return !misfits.empty(); }
};

/// Compares the torque of a log with the one that the robot needs for its motion, by joint. No joint is
/// determined if the motion cannot be computed (too few rows, no torque).
std::vector<JointMatch> fit_to_robot(const Log& log, const KnownRobot& robot);

/// Returns the misfit in the best moment of a joint: of a block that fits well, else of two successive
/// blocks, since one may fit by chance. 0 without blocks.
double best_misfit(const std::vector<double>& misfits);

/// How well an interpretation fits, over the joints that are determined: the largest misfit in the best
/// moment of a joint; the largest misfit that a third of a joint's blocks, at least two, do not exceed, as a
/// fault may begin soon; and the mean logarithm of both.
struct FitScore {
  double worst = 0.0, usual = 0.0, log_mean = 0.0;
};
FitScore score_of(const std::vector<JointMatch>& fit);

}  // namespace faultline
