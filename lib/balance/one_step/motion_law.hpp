// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "lib/balance/row_setting.hpp"
#include "lib/robot/fast_dynamics.hpp"

namespace faultline {

/// Indices of the numbers of a law of motion: base parameters; then, for each joint, viscous and Coulomb
/// friction, gain of the logged torque (1 in health) and a force added to it (N m or N; 0 in health).
struct MotionLayout {
  int base = 0, joints = 0;

  int viscous(int j) const { return base + j; }
  int coulomb(int j) const { return base + joints + j; }
  int gain(int j) const { return base + 2 * joints + j; }
  int force(int j) const { return base + 3 * joints + j; }
  int count() const { return base + 4 * joints; }
  int learned() const { return gain(0); }  ///< number of those that belong to the robot, which come first
};

/// Rigid body of a robot, prepared for the computation of its torque by base parameter.
class MotionBody {
 public:
  MotionBody() = default;
  /// `friction_width`: of tanh(dq / width), by joint, rad/s or m/s.
  MotionBody(RigidColumns rigid, Eigen::VectorXd friction_width);

  const RigidColumns& rigid() const { return rigid_; }
  const Eigen::VectorXd& friction_width() const { return friction_width_; }
  MotionLayout layout() const { return {rigid_.base(), rigid_.joints()}; }
  /// Writes the torque M ddq + h + G by base parameter to `out`, joints x base.
  void torque_by_parameter(const JointVector& q, const JointVector& dq, const JointVector& ddq,
                           Eigen::Ref<Eigen::MatrixXd> out) const;

 private:
  RigidColumns rigid_;
  Eigen::VectorXd friction_width_;
  std::vector<FastDynamics> unit_;  ///< by base parameter: it is 1, all others 0; only for parallel axes
};

/// A matrix of a robot's state: q, then dq.
using StateMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 2 * kMaxJoints, 2 * kMaxJoints>;

/// State of a robot: q, then dq.
using StateVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 2 * kMaxJoints, 1>;

/// Derivatives of an acceleration at one state. Those by a number are inverse * torque.
struct MotionSlopes {
  StateMatrix by_state;    ///< joints x 2 joints: by q, then dq
  JointMatrix inverse;     ///< of the inertia matrix; rows and columns of locked joints are 0
  Eigen::MatrixXd torque;  ///< joints x numbers: derivative of the accelerating torque by each number
};

/// Law of motion: the numbers of the robot (see MotionLayout) and its locked joints.
class MotionLaw {
 public:
  /// `body` must outlive it. Joints whose bit is set in `locked` (bit 0: the first joint) do not move.
  MotionLaw(const MotionBody& body, const Eigen::VectorXd& numbers, unsigned locked = 0);

  int joints() const { return dynamics_.joints(); }
  bool is_locked(int j) const { return (locked_ >> j & 1u) != 0; }
  const MotionBody& body() const { return *body_; }
  /// Writes the acceleration under the logged torque `tau` to `ddq`.
  void acceleration(const JointVector& q, const JointVector& dq, const JointVector& tau,
                    JointVector& ddq) const;
  /// Returns the rate at which the friction of each joint changes its velocity near rest, 1/s.
  JointVector friction_rate(const JointVector& q) const;
  /// Writes the acceleration under the logged torque `tau` to `ddq` and its derivatives to `out`.
  void acceleration_and_slopes(const JointVector& q, const JointVector& dq, const JointVector& tau,
                               JointVector& ddq, MotionSlopes& out) const;

 private:
  const MotionBody* body_;
  FastDynamics dynamics_;
  JointVector gain_, force_;
  unsigned locked_ = 0;
};

}  // namespace faultline
