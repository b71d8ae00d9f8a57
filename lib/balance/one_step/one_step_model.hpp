// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "lib/balance/one_step/linear_steps.hpp"

namespace faultline {

/// Sample period above which a log is explained by one-step predictions: a difference over a longer period is
/// no derivative.
inline constexpr double kCoarse_s = 0.020;

/// Indices of the effects of a day at coarse rates: relative change of each base parameter; then, for each
/// joint, relative friction, force added to the torque (N m or N), relative gain of the torque, and relative
/// excess of viscous over dry friction (see viscous_part).
struct StepDayLayout {
  int base = 0, joints = 0;

  int inertia(int parameter) const { return parameter; }
  int friction(int j) const { return base + j; }
  int force(int j) const { return base + joints + j; }
  int gain(int j) const { return base + 2 * joints + j; }
  int viscous_excess(int j) const { return base + 3 * joints + j; }
  int count() const { return base + 4 * joints; }
};

/// Model of a robot for logs at coarse rates: the robot, its normal variation between days and its noise.
struct OneStepModel {
  MotionBody body;
  StepSetting setting;
  Eigen::VectorXd theta;             ///< numbers of the robot, see MotionLayout::learned()
  Eigen::MatrixXd payload;           ///< base parameters x links: change by 1 kg at the end of a link
  Eigen::VectorXd carried_kg;        ///< by link: mass at its end that explains the torque of its joint best
  Eigen::VectorXd reading_variance;  ///< of the measurements: q, then dq, of each joint
  Eigen::VectorXd day_variance;      ///< prior variance of the effects of a day, see StepDayLayout
  bool torque_is_measured = false;   ///< behind the drive, so that a loss of torque does not show

  // Statistics of the healthy logs, by joint.
  Eigen::VectorXd torque_rms, q_low, q_high, top_speed;  ///< speed that 1 in 200 rows exceeds
  Eigen::VectorXi longest_repeat;  ///< longest run of samples that repeat the position before
  Eigen::VectorXd repeat_share;    ///< share of samples that repeat the position before

  int joints() const { return body.rigid().joints(); }
  MotionLayout layout() const { return body.layout(); }
  StepDayLayout day_layout() const { return {layout().base, joints()}; }
  /// Returns the numbers of the healthy robot on a day without effects.
  Eigen::VectorXd numbers() const;
  /// Returns the directions of the effects of a day in these numbers: numbers x effects.
  Eigen::MatrixXd day_directions() const;
  /// Returns the standard deviation of the unknown force (model error) in each interval of a motion: joints x
  /// intervals, N m or N.
  Eigen::MatrixXd force_std(const UniformLog& log, const Trajectory& motion) const;
  /// Returns the variance of each measurement of a log, kMissingReading for lost samples: 2 joints x samples.
  Eigen::MatrixXd variance_of_readings(const UniformLog& log) const;
};

/// Returns the measured q and dq, 2 joints x samples; without a logged velocity, differences of positions.
Trajectory readings(const UniformLog& log);

}  // namespace faultline
