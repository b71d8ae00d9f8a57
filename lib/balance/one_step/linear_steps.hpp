// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "lib/balance/one_step/motion_law.hpp"
#include "lib/balance/uniform_log.hpp"

namespace faultline {

/// How a log is integrated from sample to sample.
struct StepSetting {
  double period_s = 0.0;        ///< of the samples
  bool torque_is_held = false;  ///< between samples; else it runs straight
  double substep_s = 0.02;      ///< of a Runge-Kutta step of fourth order at most; a fast joint asks for more
};

/// The law that moves the robot, and another one that does from `begin_s` to `end_s`.
struct MotionPlan {
  const MotionLaw* usual = nullptr;
  const MotionLaw* within = nullptr;
  double begin_s = 1e300, end_s = 1e300;
  const Eigen::MatrixXd* force = nullptr;  ///< joints x intervals, N m or N: beside the torque, if any
};

/// A trajectory: q, then dq, of every sample: 2 joints x samples.
using Trajectory = Eigen::MatrixXd;

/// The one-step prediction of a log about a trajectory (equation (12) of docs/how-it-works.md). Interval k
/// lies between samples k and k + 1. Blocks of intervals stand side by side.
struct LinearSteps {
  int states = 0, numbers = 0, intervals = 0;
  Eigen::MatrixXd slope;   ///< states x (states * intervals): by the state before
  Eigen::MatrixXd miss;    ///< states x intervals: the prediction less the trajectory's next state
  Eigen::MatrixXd number;  ///< states x (numbers * intervals): by the numbers of whichever law is in force
  int within_begin = 0, within_end = 0;  ///< intervals that the other law has a part in
  Eigen::MatrixXd within;  ///< states x (numbers * those intervals): by the numbers of the other law

  auto slope_of(int k) const { return slope.middleCols(k * states, states); }
  auto number_of(int k) const { return number.middleCols(k * numbers, numbers); }
  /// Columns of the numbers' directions (numbers x n) that hold throughout, then of those of the other law:
  /// states x ((n + m) * intervals).
  Eigen::MatrixXd columns(const Eigen::MatrixXd& throughout, const Eigen::MatrixXd& other) const;
};

/// Steps that are known about another trajectory or other times of the other law: those of an interval hold
/// where the trajectory is the same and one law moves the robot all the while.
struct KnownSteps {
  const LinearSteps* steps = nullptr;  ///< null: none
  const Trajectory* about = nullptr;
  double begin_s = 1e300, end_s = 1e300;  ///< from when to when the other law moved the robot in them
  bool laws_are_alike = false;            ///< steps of the usual law stand for those of the other one, too
};

/// Linear in the state and in the numbers of both laws.
LinearSteps linear_steps(const UniformLog& log, const Trajectory& about, const StepSetting& setting,
                         const MotionPlan& plan, const KnownSteps& known = {});

/// State after interval `k` of the log that begins in the trajectory's.
Eigen::VectorXd next_state(const UniformLog& log, int k, const Trajectory& about, const StepSetting& setting,
                           const MotionPlan& plan);

/// Share of the time that a velocity is near rest which runs straight from `begin` to `end`: within some
/// widths of the friction's change of sign.
double share_near_rest(double begin, double end, double friction_width);

}  // namespace faultline
