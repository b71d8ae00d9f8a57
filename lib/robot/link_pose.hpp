// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include "lib/core/elementary/elementary.hpp"
#include "lib/robot/chain.hpp"

/// Kinematics from one link to the next, templated on the scalar.
namespace faultline {

namespace detail {

/// Rotation by `angle` about the unit vector `axis` (Rodrigues): child coordinates to parent coordinates.
template <typename S>
Matrix3<S> rotation_about(const Eigen::Vector3d& axis, const S& angle) {
  const auto [s, c] = elementary::sin_cos(angle);
  const S v = S(1.0) - c;
  const double x = axis.x(), y = axis.y(), z = axis.z();
  Matrix3<S> r;
  r << c + v * (x * x), v * (x * y) - s * z, v * (x * z) + s * y,  //
      v * (x * y) + s * z, c + v * (y * y), v * (y * z) - s * x,   //
      v * (x * z) - s * y, v * (y * z) + s * x, c + v * (z * z);
  return r;
}

/// Pose of link i's frame in the frame of link i-1.
template <typename S>
struct LinkPose {
  Matrix3<S> rotation;  ///< link i to link i-1
  Vector3<S> position;  ///< origin of link i, in link i-1
};

template <typename S>
LinkPose<S> link_pose(const Chain<S>& chain, int i, const S& q) {
  const JointGeometry& joint = chain.geometry[i];
  LinkPose<S> pose;
  pose.position = joint.offset.template cast<S>();
  if (i > 0) pose.position += chain.length[i - 1] * joint.direction.template cast<S>();
  if (joint.kind == AxisKind::revolute) {
    pose.rotation = rotation_about(joint.axis, q);
  } else {
    pose.rotation = Matrix3<S>::Identity();
    pose.position += q * joint.axis.template cast<S>();
  }
  return pose;
}

}  // namespace detail

}  // namespace faultline
