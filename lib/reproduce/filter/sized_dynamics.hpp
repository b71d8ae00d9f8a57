// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "lib/evidence/motion_model.hpp"
#include "lib/reproduce/filter/hypothesis.hpp"
#include "lib/reproduce/filter/joint_array.hpp"
#include "lib/robot/fast_dynamics.hpp"

namespace faultline {

/// Steps up to this long are short: one midpoint step does.
inline constexpr double kShortStep_s = 0.004;
/// Longer steps are cut into steps of Runge-Kutta of at most this length.
inline constexpr double kLongestSubstep_s = 0.01;
/// Steps up to this long take the analytic transition, longer ones one along substeps.
inline constexpr double kAnalyticStep_s = 0.012;

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
  JointArray tip_torque;  ///< on every joint, of a kilogram; where asked for and the tip's mass is a state
};

/// A hypothesis with the sizes it is taken at, and the slow states (MotionModel::slow; none means all 0);
/// without a hypothesis the robot is healthy.
struct SizedFault {
  const Hypothesis* hypothesis = nullptr;
  std::span<const double> sizes{};
  std::span<const double> slow{};
  /// By joint: the torque whose effect tells gains and masses. A controller answers the noise of its sensors,
  /// and a filter with more process noise than the robot has takes the noise for motion: what both share
  /// would be taken for a robot that moves more than it should. Empty: all that acts.
  std::span<const double> drive_level{};
};

/// What the equations of motion take from the model, worked out once.
struct RobotLoad {
  const MotionModel& model;
  FastDynamics healthy;
  FastDynamics unit_payload;            ///< the chain with 1 kg more at its tip
  FastDynamics::Bodies payload_bodies;  ///< what that kilogram adds, where the dynamics are planar
  double least_payload = 0.0;  ///< kg, less than 0: with less at the tip hardly any inertia is left somewhere

  explicit RobotLoad(const MotionModel& motion_model);
};

/// The equations of motion at given sizes of a fault and given slow states.
class SizedDynamics {
 public:
  SizedDynamics(const RobotLoad& load, const SizedFault& fault);

  /// Accelerations under a drive torque (N m or N); `with_tip` asks for the tip's torque as well.
  Acceleration evaluate(const MotionState& at, const JointArray& torque, bool with_tip) const;
  /// Moves the state over `dt` (s) under a constant torque: the midpoint rule for short steps, else
  /// Runge-Kutta; linearly implicit where friction is stiff. Returns the accelerations at the middle of the
  /// step (short) or its start (long), with the tip's torque where the analytic transition needs it.
  Acceleration integrate(MotionState& state, const JointArray& torque, double dt) const;
  /// One step with the accelerations given: at its start or, to second order, in its middle; linearly
  /// implicit, and then from those at its start, where friction is stiff.
  void advance(MotionState& state, const Acceleration& at, double h) const;
  /// Steps that `dt` is cut into so that none is longer than `longest_s`, and none stiff if few suffice.
  static int substeps(const Acceleration& at, double dt, double longest_s);
  static bool is_stiff(const Acceleration& at, double h);

 private:
  struct RigidBody;
  /// What accelerates each joint on its way, with the steepest that its friction can be.
  struct NetTorque {
    JointArray value, steepest;
  };

  void take_slow_states(const SizedFault& fault);
  void rigid_body(const MotionState& at, RigidBody& body) const;
  JointArray telling_acceleration(const JointArray& torque, const Acceleration& at) const;
  void tip_torque(const RigidBody& body, const JointArray& torque, Acceleration& out) const;
  void take_extra_torque(const RigidBody& body, NetTorque& net, Acceleration& out) const;
  void lose_to_load(const MotionState& at, NetTorque& net, Acceleration& out) const;
  JointArray net_torque(const MotionState& at, const JointArray& torque, const RigidBody& body,
                        Acceleration& out) const;
  Acceleration midpoint_step(MotionState& state, const Acceleration& start, const JointArray& torque,
                             double h) const;
  void implicit_step(MotionState& state, const Acceleration& at, double h) const;
  void runge_kutta_step(MotionState& state, const JointArray& torque, double h) const;

  const RobotLoad& load_;
  std::span<const double> sizes_, drive_level_;
  FaultKind kind_;
  int joints_;
  int joint_ = -1;  ///< of the fault
  bool everywhere_ = false;
  JointArray friction_scale_, gain_;
  JointArray slow_torque_;  ///< beside the drive's, N m or N
  JointArray coloured_;     ///< of that, what passes
  double tip_mass_ = 0.0;   ///< kg, beside what was identified
  bool tip_is_free_ = false;
  FastDynamics::Bodies bodies_;  ///< with the tip's mass, where the dynamics are planar
};

}  // namespace faultline
