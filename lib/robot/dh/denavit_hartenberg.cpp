// SPDX-License-Identifier: MIT
#include "lib/robot/dh/denavit_hartenberg.hpp"

#include "lib/robot/turns.hpp"

namespace faultline {
namespace {

Eigen::Isometry3d pose(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& position) {
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  result.linear() = rotation;
  result.translation() = position;
  return result;
}

}  // namespace

Eigen::Isometry3d dh_transform(const DhRow& row, DhConvention convention) {
  const Eigen::Isometry3d about_z = pose(turn_z(row.theta), {0.0, 0.0, row.d});
  const Eigen::Isometry3d about_x = pose(turn_x(row.alpha), {row.a, 0.0, 0.0});
  return convention == DhConvention::standard ? about_z * about_x : about_x * about_z;
}

DhGeometry dh_geometry(const std::vector<AxisKind>& kinds, const std::vector<DhRow>& rows,
                       DhConvention convention) {
  DhGeometry geometry;
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();  // the table's frame in the base frame at q = 0
  Eigen::Vector3d last = Eigen::Vector3d::Zero();           // origin of the joint before, in the base frame
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Eigen::Isometry3d next = frame * dh_transform(rows[i], convention);
    const Eigen::Isometry3d& own = convention == DhConvention::standard ? frame : next;
    JointGeometry joint;
    joint.kind = kinds[i];
    joint.axis = without_dust(own.linear().col(2)).normalized();
    joint.offset = without_dust(own.translation() - last);
    joint.direction.setZero();
    geometry.joints.push_back(joint);
    last = own.translation();
    frame = next;
  }
  geometry.tip = without_dust(frame.translation() - last);
  return geometry;
}

}  // namespace faultline
