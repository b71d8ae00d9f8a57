// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <type_traits>
#include <vector>

#include "lib/balance/one_step/motion_law.hpp"
#include "lib/balance/uniform_log.hpp"
#include "lib/robot/chain.hpp"

namespace faultline {

/// Number of states up to which the matrices have a size known at compile time.
inline constexpr int kMostFixedStates = 8;

/// Number of joints for a number of states; both may be Eigen::Dynamic.
template <int kStates>
inline constexpr int kJointsOf = kStates == Eigen::Dynamic ? Eigen::Dynamic : kStates / 2;

/// A matrix that is not stored on the heap; kRows and kColumns may be Eigen::Dynamic, then at most as large
/// as for a robot of kMaxJoints.
template <int kRows, int kColumns>
using SmallMatrix =
    Eigen::Matrix<double, kRows, kColumns, kRows == 1 && kColumns != 1 ? Eigen::RowMajor : Eigen::ColMajor,
                  kRows == Eigen::Dynamic ? 2 * kMaxJoints : kRows,
                  kColumns == Eigen::Dynamic ? 3 * kMaxJoints : kColumns>;

/// Calls `function` with the number of states (2 to 16, even) as a compile-time constant, with which it takes
/// half the time; more than kMostFixedStates are Eigen::Dynamic, since each size takes seconds to compile.
template <int kStates = 2, typename Function>
auto with_state_count(int states, const Function& function) {
  if constexpr (kStates < kMostFixedStates) {
    if (states > kStates) return with_state_count<kStates + 2>(states, function);
  } else {
    if (states > kStates) return function(std::integral_constant<int, Eigen::Dynamic>{});
  }
  return function(std::integral_constant<int, kStates>{});
}

/// Settings of the integration from sample to sample.
struct StepSetting {
  double period_s = 0.0;        ///< of the samples
  bool torque_is_held = false;  ///< between samples; else it is interpolated linearly
  double substep_s = 0.02;      ///< longest Runge-Kutta step of fourth order; a fast joint takes shorter ones
};

/// The law of motion `usual`, and the law `within` that replaces it from `begin_s` to `end_s`.
struct MotionPlan {
  const MotionLaw* usual = nullptr;
  const MotionLaw* within = nullptr;
  double begin_s = 1e300, end_s = 1e300;
  const Eigen::MatrixXd* force = nullptr;  ///< joints x intervals, N m or N: added to the torque; null: none
};

/// A trajectory: q, then dq, of every sample: 2 joints x samples.
using Trajectory = Eigen::MatrixXd;

/// The one-step prediction of a log about a trajectory (equation (12) of docs/how-it-works.md). Interval k
/// lies between samples k and k + 1. Blocks of intervals stand side by side.
struct LinearSteps {
  int states = 0, numbers = 0, intervals = 0;
  Eigen::MatrixXd slope;   ///< states x (states * intervals): derivative by the state before
  Eigen::MatrixXd miss;    ///< states x intervals: predicted minus next state of the trajectory
  Eigen::MatrixXd number;  ///< states x (numbers * intervals): derivative by the numbers of both laws
  int within_begin = 0, within_end = 0;  ///< intervals in which the law `within` acts
  Eigen::MatrixXd within;  ///< states x (numbers * those intervals): by the numbers of the law `within` alone

  auto slope_of(int k) const { return slope.middleCols(k * states, states); }
  auto number_of(int k) const { return number.middleCols(k * numbers, numbers); }
  /// Returns the columns of directions in the numbers of both laws (`throughout`, numbers x n), then in those
  /// of the law `within` alone (`other`, numbers x m): states x ((n + m) * intervals).
  Eigen::MatrixXd columns(const Eigen::MatrixXd& throughout, const Eigen::MatrixXd& other) const;
};

/// Steps computed before, about another trajectory or for other times of the law `within`. Those of an
/// interval are used again if its trajectory is the same and one law holds throughout the interval.
struct KnownSteps {
  const LinearSteps* steps = nullptr;  ///< null: none
  const Trajectory* about = nullptr;
  double begin_s = 1e300, end_s = 1e300;  ///< times of the law `within` in these steps
  bool laws_are_alike = false;            ///< steps of the usual law are also those of the law `within`
};

/// Linearises the one-step predictions of a log about a trajectory, by the state and the numbers of both
/// laws.
LinearSteps linear_steps(const UniformLog& log, const Trajectory& about, const StepSetting& setting,
                         const MotionPlan& plan, const KnownSteps& known = {});

/// Returns the state after interval `k` of the log if it is that of the trajectory at its begin: q, then dq.
Eigen::VectorXd next_state(const UniformLog& log, int k, const Trajectory& about, const StepSetting& setting,
                           const MotionPlan& plan);

/// Returns the share of the time for which a velocity that changes linearly from `begin` to `end` is near
/// rest: within some widths of the change of sign of the friction.
double share_near_rest(double begin, double end, double friction_width);

}  // namespace faultline
