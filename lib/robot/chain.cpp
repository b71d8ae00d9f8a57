// SPDX-License-Identifier: MIT
#include "lib/robot/chain.hpp"

namespace faultline {
namespace {

/// |v|^2 1 - v v^T: the inertia of a unit point mass at v.
Eigen::Matrix3d point_inertia(const Eigen::Vector3d& v) {
  return v.squaredNorm() * Eigen::Matrix3d::Identity() - v * v.transpose();
}

}  // namespace

LinkInertia<double> uniform_rod(double mass, double length, const Eigen::Vector3d& direction) {
  LinkInertia<double> link;
  link.mass = mass;
  link.first_moment = 0.5 * mass * length * direction;
  link.inertia = mass * length * length / 3.0 * point_inertia(direction);
  return link;
}

LinkInertia<double> point_mass(double mass) {
  LinkInertia<double> link;
  link.mass = mass;
  return link;
}

LinkInertia<double> general_body(double mass, const Eigen::Vector3d& centre,
                                 const Eigen::Matrix3d& inertia_at_centre) {
  LinkInertia<double> link;
  link.mass = mass;
  link.first_moment = mass * centre;
  link.inertia = inertia_at_centre + mass * point_inertia(centre);
  return link;
}

LinkInertia<double> seen_from(const LinkInertia<double>& body, const Eigen::Matrix3d& rotation,
                              const Eigen::Vector3d& position) {
  const Eigen::Vector3d turned = rotation * body.first_moment, &p = position;
  LinkInertia<double> seen;
  seen.mass = body.mass;
  seen.first_moment = turned + body.mass * p;
  seen.inertia = rotation * body.inertia * rotation.transpose() + body.mass * point_inertia(p) +
                 2.0 * p.dot(turned) * Eigen::Matrix3d::Identity() - p * turned.transpose() -
                 turned * p.transpose();
  return seen;
}

Chain<double> with_tip_mass(const Chain<double>& chain, double kg) {
  Chain<double> loaded = chain;
  const int last = chain.joints() - 1;
  LinkInertia<double>& link = loaded.links[last];
  const JointGeometry& joint = chain.geometry[last];
  const bool has_reach = joint.kind == AxisKind::revolute && joint.direction.squaredNorm() > 0.0;
  const Eigen::Vector3d at =
      has_reach ? Eigen::Vector3d(chain.length[last] * joint.direction) : Eigen::Vector3d::Zero();
  const LinkInertia<double> body = general_body(kg, at, Eigen::Matrix3d::Zero());
  link.mass += body.mass;
  link.first_moment += body.first_moment;
  link.inertia += body.inertia;
  return loaded;
}

}  // namespace faultline
