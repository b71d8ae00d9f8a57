// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

/// Constant rotations without rounding residue: a quarter turn has exact zeros instead of 6e-17.
namespace faultline {

/// Rotation by `angle` (rad) about x.
Eigen::Matrix3d turn_x(double angle);
/// Rotation by `angle` (rad) about z.
Eigen::Matrix3d turn_z(double angle);
/// Roll, pitch and yaw (rad) about fixed x, y and z: Rz(yaw) Ry(pitch) Rx(roll), as in URDF.
Eigen::Matrix3d turn_rpy(const Eigen::Vector3d& rpy);
/// Returns `v` with components below 1e-15 times the largest set to 0.
Eigen::Vector3d without_dust(const Eigen::Vector3d& v);

}  // namespace faultline
