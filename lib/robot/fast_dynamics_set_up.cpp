// SPDX-License-Identifier: MIT
// Computes the constants of FastDynamics for a chain; fast_dynamics.cpp evaluates its equations at a state.
#include <Eigen/Geometry>
#include <algorithm>

#include "lib/robot/fast_dynamics.hpp"

namespace faultline {
namespace {

constexpr double kParallel = 1e-13;

bool has_parallel_axes(const Chain& chain) {
  const Eigen::Vector3d& normal = chain.geometry[0].axis;
  for (const JointGeometry& joint : chain.geometry)
    if (joint.axis.cross(normal).norm() > kParallel) return false;
  return true;
}

/// The bodies that turn rigidly with a revolute joint, projected along the normal, about that joint.
struct PlanarBody {
  double mass = 0.0;
  Eigen::Vector2d first_moment = Eigen::Vector2d::Zero();
  double inertia = 0.0;
  Eigen::Vector2d reach = Eigen::Vector2d::Zero();  ///< vector to the next revolute joint
};

}  // namespace

FastDynamics::FastDynamics(const Chain& chain) : chain_(chain), joints_(chain.joints()) {
  for (const auto& f : chain_.friction)
    has_friction_ = has_friction_ || f.viscous != 0.0 || f.coulomb != 0.0 || f.offset != 0.0 ||
                    f.bend != 0.0 || f.skew != 0.0;
  has_extra_ = !chain_.ripples.empty() || !chain_.shared_drives.empty();
  for (const auto& f : chain_.friction) has_extra_ = has_extra_ || f.load != 0.0;
  if (chain_.rotor_inertia.empty()) chain_.rotor_inertia.assign(joints_, 0.0);
  planar_ = joints_ > 0 && has_parallel_axes(chain_);
  if (planar_)
    set_up_planar(chain_.geometry[0].axis);
  else
    spatial_ = SpatialDynamics(chain_);
}

void FastDynamics::set_up_planar(const Eigen::Vector3d& normal) {
  Eigen::Matrix<double, 2, 3> plane;
  const Eigen::Vector3d u = normal.unitOrthogonal();
  plane << u.transpose(), normal.cross(u).transpose();
  PerJoint<PlanarBody> bodies{};
  Eigen::Vector2d place = Eigen::Vector2d::Zero();  // origin of the link's frame on its planar body
  for (int i = 0; i < joints_; ++i) {
    const JointGeometry& joint = chain_.geometry[i];
    sign_[i] = joint.axis.dot(normal) > 0.0 ? 1.0 : -1.0;
    Eigen::Vector3d offset = joint.offset;
    if (i > 0) offset += chain_.length[i - 1] * joint.direction;
    place += plane * offset;
    if (joint.kind == AxisKind::revolute) {
      if (revolute_ > 0) bodies[revolute_ - 1].reach = place;
      revolute_joint_[revolute_++] = i;
      place.setZero();
    } else {
      prismatic_joint_[prismatic_++] = i;
    }
    if (revolute_ == 0) continue;
    const LinkInertia& link = chain_.links[i];
    const Eigen::Vector2d moment = plane * link.first_moment;
    PlanarBody& body = bodies[revolute_ - 1];
    body.mass += link.mass;
    body.first_moment += moment + link.mass * place;
    body.inertia +=
        normal.dot(link.inertia * normal) + 2.0 * place.dot(moment) + link.mass * place.squaredNorm();
  }
  std::copy_n(chain_.rotor_inertia.begin(), joints_, bodies_.rotor_inertia.begin());
  double carried = 0.0;
  for (int i = joints_ - 1; i >= 0; --i) {
    carried += chain_.links[i].mass;
    bodies_.carried_mass[i] = carried;
    bodies_.weight[i] = -sign_[i] * normal.dot(chain_.gravity) * carried;
  }
  const Eigen::Vector2d g = plane * chain_.gravity;
  gravity_in_plane_ = g.norm() > 1e-14 * chain_.gravity.norm();
  double beyond = 0.0;
  for (int j = revolute_ - 1; j >= 0; --j) {
    const Eigen::Vector2d s = bodies[j].first_moment + beyond * bodies[j].reach;
    bodies_.diagonal[j] = bodies[j].inertia + beyond * bodies[j].reach.squaredNorm();
    bodies_.gravity[j] = {g.x() * s.y() - g.y() * s.x(), g.x() * s.x() + g.y() * s.y()};
    for (int i = 0; i < j; ++i) {
      const Eigen::Vector2d& d = bodies[i].reach;
      bodies_.pairs[i][j] = {d.dot(s), d.y() * s.x() - d.x() * s.y()};
    }
    beyond += bodies[j].mass;
  }
}

}  // namespace faultline
