// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "lib/evidence/filter/joint_array.hpp"
#include "lib/evidence/motion_model.hpp"
#include "lib/robot/fast_dynamics.hpp"

namespace faultline {

/// Steps up to this long are short: one midpoint step does.
inline constexpr double kShortStep_s = 0.004;
/// Longer steps are cut into steps of Runge-Kutta of at most this length.
inline constexpr double kLongestSubstep_s = 0.005;

/// Joint accelerations with what a covariance needs besides.
struct Acceleration {
  JointArray value;
  JointSquare inverse_inertia;  ///< zero in the row and column of a locked joint
  JointArray friction_slope;    ///< dF/d(dq)
  double stiffness = 0.0;       ///< 1/s: how fast friction can stop a joint at most
  /// Generalised torque a unit of each fault size adds, where that is one joint's.
  std::array<JointArray, kMostSizes> size_torque;
  // The same of a unit of each slow state; the others are torques themselves.
  JointArray friction_torque;
  JointArray gain_torque;
  JointArray tip_torque;  ///< on every joint, of a kilogram; where the tip's mass is in the state
};

/// A hypothesis with the sizes it is taken at, and the slow states (MotionModel::slow; none means all 0);
/// without a hypothesis the robot is healthy.
struct SizedFault {
  const Hypothesis* hypothesis = nullptr;
  std::span<const double> sizes{};
  std::span<const double> slow{};
};

/// The equations of motion under a hypothesis, or of the healthy robot.
class FaultDynamics {
 public:
  explicit FaultDynamics(const MotionModel& model);

  int joints() const { return joints_; }
  /// Accelerations under a drive torque (N m or N).
  Acceleration evaluate(const MotionState& at, const JointArray& torque, const SizedFault& fault = {}) const;
  /// Moves the state over `dt` (s) under a constant torque: the midpoint rule for short steps, else
  /// Runge-Kutta with substeps of at most 5 ms; linearly implicit where friction is stiff.
  /// Returns the accelerations at the middle of the step (short) or its start (long).
  Acceleration integrate(MotionState& state, const JointArray& torque, double dt,
                         const SizedFault& fault = {}) const;
  /// The same by the midpoint rule with substeps of about 25 ms where friction allows: for derivatives, which
  /// bear the coarseness.
  void integrate_coarsely(MotionState& state, const JointArray& torque, double dt,
                          const SizedFault& fault = {}) const;
  /// Change of velocity when joint j is stopped at once by a torque on that joint alone.
  JointArray stopping_impulse(const MotionState& at, int j) const;

 private:
  struct RigidBody;
  struct SlowLoad;

  SlowLoad slow_load(const SizedFault& fault) const;
  RigidBody rigid_body(const MotionState& at, const SizedFault& fault, const SlowLoad& slow) const;
  JointArray net_torque(const MotionState& at, const JointArray& torque, const SizedFault& fault,
                        const SlowLoad& slow, const RigidBody& body, Acceleration& out) const;
  Acceleration midpoint_step(MotionState& state, const Acceleration& start, const JointArray& torque,
                             double h, const SizedFault& fault) const;
  void implicit_step(MotionState& state, const Acceleration& at, double h) const;
  void runge_kutta_step(MotionState& state, const JointArray& torque, double h,
                        const SizedFault& fault) const;

  const MotionModel& model_;
  FastDynamics healthy_;
  FastDynamics unit_payload_;  ///< the chain with 1 kg more at its tip
  int joints_;
};

}  // namespace faultline
