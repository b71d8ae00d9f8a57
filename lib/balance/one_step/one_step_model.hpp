// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "lib/balance/one_step/linear_steps.hpp"

namespace faultline {

/// Sample period above which a log is explained by one-step predictions: a difference over a longer one is no
/// derivative.
inline constexpr double kCoarse_s = 0.020;

/// Where the effects of a day stand at coarse rates: relative change of each base parameter; then, for each
/// joint, relative friction, force beside the torque (N m or N) and relative gain of the torque.
struct StepDayLayout {
  int base = 0, joints = 0;

  int inertia(int parameter) const { return parameter; }
  int friction(int joint) const { return base + joint; }
  int force(int joint) const { return base + joints + joint; }
  int gain(int joint) const { return base + 2 * joints + joint; }
  int count() const { return base + 3 * joints; }
};

/// A robot as logs at coarse rates show it, with what is normal to differ from day to day and its noise.
struct OneStepModel {
  MotionBody body;
  StepSetting setting;
  Eigen::VectorXd theta;             ///< the robot's own numbers, see MotionLayout::learned()
  Eigen::MatrixXd payload;           ///< base parameters x links: what 1 kg at the end of a link adds to them
  Eigen::VectorXd carried_kg;        ///< by link: mass at its end that the torque of its joint is like
  Eigen::VectorXd reading_variance;  ///< of q, then dq, of each joint
  Eigen::VectorXd day_variance;      ///< prior variance of the effects of a day, see StepDayLayout
  bool torque_is_measured = false;   ///< behind the drive: then a loss of torque does not show

  // What the healthy logs looked like, by joint.
  Eigen::VectorXd torque_rms, q_low, q_high, top_speed;  ///< speed that 1 in 200 rows exceeds
  Eigen::VectorXi longest_repeat;  ///< samples by which a position repeats the one before, at most
  Eigen::VectorXd repeat_share;    ///< of samples that repeat the position before

  int joints() const { return body.rigid().joints(); }
  MotionLayout layout() const { return body.layout(); }
  StepDayLayout day_layout() const { return {layout().base, joints()}; }
  /// Numbers of the healthy robot on a usual day.
  Eigen::VectorXd numbers() const;
  /// Directions of the effects of a day in these numbers: numbers x effects.
  Eigen::MatrixXd day_directions() const;
  /// Standard deviation of the force that the model lacks in each interval of a motion: joints x intervals,
  /// N m or N.
  Eigen::MatrixXd force_std(const UniformLog& log, const Trajectory& motion) const;
  /// Variance of each reading of a log; lost samples have none: 2 joints x samples.
  Eigen::MatrixXd variance_of_readings(const UniformLog& log) const;
};

/// Measured q and dq, 2 joints x samples; without a logged velocity the differences of the positions.
Trajectory readings(const UniformLog& log);

}  // namespace faultline
