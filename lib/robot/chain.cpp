// SPDX-License-Identifier: MIT
#include "lib/robot/chain.hpp"

#include <cmath>

namespace faultline {
namespace {

/// |v|^2 1 - v v^T: the inertia of a unit point mass at v.
Eigen::Matrix3d point_inertia(const Eigen::Vector3d& v) {
  return v.squaredNorm() * Eigen::Matrix3d::Identity() - v * v.transpose();
}

}  // namespace

LinkInertia uniform_rod(double mass, double length, const Eigen::Vector3d& direction) {
  return {mass, 0.5 * mass * length * direction, mass * length * length / 3.0 * point_inertia(direction)};
}

LinkInertia point_mass(double mass) { return {.mass = mass}; }

LinkInertia general_body(double mass, const Eigen::Vector3d& centre,
                         const Eigen::Matrix3d& inertia_at_centre) {
  return {mass, mass * centre, inertia_at_centre + mass * point_inertia(centre)};
}

LinkInertia seen_from(const LinkInertia& body, const Eigen::Matrix3d& rotation,
                      const Eigen::Vector3d& position) {
  const Eigen::Vector3d turned = rotation * body.first_moment, &p = position;
  return {body.mass, turned + body.mass * p,
          rotation * body.inertia * rotation.transpose() + body.mass * point_inertia(p) +
              2.0 * p.dot(turned) * Eigen::Matrix3d::Identity() - p * turned.transpose() -
              turned * p.transpose()};
}

double steepest(const Friction& f, double torque) {
  return f.viscous + (std::abs(f.coulomb) + std::abs(f.load) * torque) / f.width +
         std::abs(f.bend) / f.bend_width + std::abs(f.skew);
}

}  // namespace faultline
