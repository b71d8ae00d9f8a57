// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

/// Constant turns of frames, in numbers that read well: a quarter turn has zeros where rounding leaves 6e-17.
namespace faultline {

/// By `angle` (rad) about x.
Eigen::Matrix3d turn_x(double angle);
/// By `angle` (rad) about z.
Eigen::Matrix3d turn_z(double angle);
/// Roll, pitch and yaw (rad) about fixed x, y and z: Rz(yaw) Ry(pitch) Rx(roll), as in URDF.
Eigen::Matrix3d turn_rpy(const Eigen::Vector3d& rpy);
/// Components below 1e-15 times the largest become 0.
Eigen::Vector3d without_dust(const Eigen::Vector3d& v);

}  // namespace faultline
