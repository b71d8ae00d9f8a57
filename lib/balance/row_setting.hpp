// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "lib/robot/chain.hpp"

namespace faultline {

/// A torque that repeats with a joint's position: sine and cosine of rate * q, alone and times the torque.
struct RippleRate {
  int joint = 0;      ///< from 0
  double rate = 0.0;  ///< 1/rad or 1/m
};

/// How the torque-balance rows of a robot are made; the same for all its logs.
struct RowSetting {
  double period_s = 0.0;        ///< of the samples
  int averaged = 1;             ///< recorded samples that each of them is the mean of (averaged())
  double kernel_s = 0.010;      ///< standard deviation of the kernel that smooths torque and columns
  double friction_s = 0.006;    ///< the same for the velocity that friction depends on
  int decimation = 1;           ///< samples between two rows; never finer than the kernel
  bool torque_is_held = false;  ///< between recorded samples; else it runs straight
  int torque_lag = 0;  ///< of the torque that acts now, in samples: positive where it is logged too late
  bool velocity_is_difference = false;  ///< the logged velocity holds nothing that the positions do not hold
  Eigen::VectorXd fusion;  ///< by joint: decay of the average that mixes difference and logged velocity
  Eigen::VectorXd friction_width;  ///< by joint: rad/s or m/s of tanh(dq / width)
  Eigen::VectorXd compliance;      ///< by joint: of the gear spring, rad per N m or m per N; 0: rigid
  std::vector<RippleRate> ripples;

  int joints() const { return static_cast<int>(friction_width.size()); }
  double row_s() const { return period_s * decimation; }  ///< between two rows
};

/// The rigid body of a chain as the columns see it: base parameters are what torques can tell.
struct RigidColumns {
  Chain chain;           ///< geometry and gravity; its inertias and friction do not count
  Eigen::MatrixXd lift;  ///< (11 n) x base: the links' inertial numbers, then rotors, that stand for the base

  int joints() const { return chain.joints(); }
  int base() const { return static_cast<int>(lift.cols()); }
};

/// Where the parameters of a robot stand in its columns: base, then friction, offset, delay and spring of
/// each joint, then the ripples.
struct ColumnLayout {
  int base = 0, joints = 0, ripples = 0;

  int viscous(int joint) const { return base + joint; }
  int coulomb(int joint) const { return base + joints + joint; }
  int offset(int joint) const { return base + 2 * joints + joint; }
  int delay(int joint) const { return base + 3 * joints + joint; }
  int spring(int joint) const { return base + 4 * joints + joint; }
  int ripple(int k) const { return base + 5 * joints + 4 * k; }  ///< four: sin and cos times torque, sin, cos
  int count() const { return ripple(ripples); }
  int rigid() const { return offset(0); }  ///< columns of inertia, gravity and friction come before it
};

inline ColumnLayout layout_of(const RigidColumns& rigid, const RowSetting& setting) {
  return {rigid.base(), rigid.joints(), static_cast<int>(setting.ripples.size())};
}

}  // namespace faultline
