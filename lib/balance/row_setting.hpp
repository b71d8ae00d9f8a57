// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "lib/core/joint.hpp"
#include "lib/robot/chain.hpp"

namespace faultline {

/// A torque that repeats with a joint's position: sine and cosine of rate * q, alone and times the torque.
struct RippleRate {
  Joint joint{};
  double rate = 0.0;  ///< 1/rad or 1/m
};

/// A drive that turns at a weighted sum of the joints' speeds, such as the last motor of many wrists.
struct CoupledDrive {
  Eigen::VectorXd along;        ///< weight of each joint's speed
  double friction_width = 0.0;  ///< rad/s or m/s of tanh(speed / width)
};

/// Settings of the torque-balance rows of a robot; the same for all its logs.
struct RowSetting {
  double period_s = 0.0;        ///< of the samples
  int averaged = 1;             ///< recorded samples of which each sample is the mean (averaged())
  double kernel_s = 0.010;      ///< standard deviation of the kernel that smooths torque and columns
  double friction_s = 0.006;    ///< the same for the velocity that friction depends on
  int decimation = 1;           ///< samples between two rows; never finer than the kernel
  bool torque_is_held = false;  ///< between recorded samples; else it is interpolated linearly
  int torque_lag = 0;  ///< samples by which the acting torque is logged too late; negative: too early
  /// By joint: decay of the average that mixes difference and logged velocity; 0: the velocity was computed
  /// from the position, or there is none.
  Eigen::VectorXd fusion;
  Eigen::VectorXd friction_width;  ///< by joint: rad/s or m/s of tanh(dq / width)
  Eigen::VectorXd compliance;      ///< by joint: of the gear spring, rad per N m or m per N; 0: rigid
  std::vector<CoupledDrive> drives;
  std::vector<RippleRate> ripples;

  int joints() const { return static_cast<int>(friction_width.size()); }
  /// Whether the logged velocity of a joint (from 0) is a measurement of its own.
  bool measures_velocity(int j) const { return fusion.size() > 0 && fusion[j] > 0.0; }
  double row_s() const { return period_s * decimation; }  ///< between two rows
};

/// Rigid body of a chain by base parameters: the combinations that torques determine.
struct RigidColumns {
  Chain chain;           ///< geometry and gravity; its inertias and friction are not used
  Eigen::MatrixXd lift;  ///< (11 n) x base: inertial parameters of the links, then rotors, by base parameter

  int joints() const { return chain.joints(); }
  int base() const { return static_cast<int>(lift.cols()); }
};

/// Indices of the parameters of a robot in its columns: base, then friction (viscous, Coulomb, by load),
/// offset, delay and spring of each joint, then the coupled drives, then the ripples.
struct ColumnLayout {
  int base = 0, joints = 0, drives = 0, ripples = 0;

  int viscous(int j) const { return base + j; }
  int coulomb(int j) const { return base + joints + j; }
  int load(int j) const { return base + 2 * joints + j; }  ///< share of the torque that is carried
  int offset(int j) const { return base + 3 * joints + j; }
  int delay(int j) const { return base + 4 * joints + j; }
  int spring(int j) const { return base + 5 * joints + j; }
  int drive(int k) const { return base + 6 * joints + 3 * k; }  ///< three: inertia, viscous, Coulomb friction
  int ripple(int k) const { return drive(drives) + 4 * k; }     ///< four: sin and cos times torque, sin, cos
  int ripple_sine(int k) const { return ripple(k) + 2; }        ///< sine alone, cosine alone
  int count() const { return ripple(ripples); }
  int rigid() const { return offset(0); }  ///< columns of inertia, gravity and friction, which come first
};

inline ColumnLayout layout_of(const RigidColumns& rigid, const RowSetting& setting) {
  return {rigid.base(), rigid.joints(), static_cast<int>(setting.drives.size()),
          static_cast<int>(setting.ripples.size())};
}

}  // namespace faultline
