// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "lib/balance/one_step/motion_law.hpp"

namespace faultline {

/// Part of an interval that one law moves.
struct Part {
  const MotionLaw* law = nullptr;
  double begin_s = 0.0, end_s = 0.0;  ///< from the interval's start
  bool within = false;                ///< the other law
};

/// The torque within one interval.
struct IntervalTorque {
  JointVector<double> begin, slope;  ///< at its start, and by the time

  JointVector<double> at(double s) const { return begin + s * slope; }
};

/// Derivatives of the state behind some time by the state before it and by each number of the law.
struct Tangent {
  StateMatrix by_state;
  Eigen::MatrixXd by_number;

  Tangent(int states, int numbers)
      : by_state(StateMatrix::Identity(states, states)), by_number(Eigen::MatrixXd::Zero(states, numbers)) {}

  /// Moves it by a step of length `h` whose slopes are constant: the Taylor series of fourth order of the
  /// exponential, by halved steps that are then doubled where it would not converge (Moler and Van Loan 2003,
  /// method 3).
  void move(double h, const MotionSlopes& at);
};

/// Moves the state through one part by Runge-Kutta steps of fourth order.
void move(const Part& part, const IntervalTorque& torque, int substeps, Eigen::VectorXd& state);
/// The same, with its derivatives, which take one step for two of the state: its slopes are Simpson's mean of
/// those before, between and after the two. `substeps` is even.
Tangent move_with_slopes(const Part& part, const IntervalTorque& torque, int substeps,
                         Eigen::VectorXd& state);

}  // namespace faultline
