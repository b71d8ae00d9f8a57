// SPDX-License-Identifier: MIT
#include "lib/robot/dh/denavit_hartenberg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "lib/robot/turns.hpp"

namespace faultline {
namespace {

Eigen::Isometry3d pose(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& position) {
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  result.linear() = rotation;
  result.translation() = position;
  return result;
}

/// Returns the pose of the row's frame in the frame before it, at q = 0.
Eigen::Isometry3d dh_transform(const DhRow& row, DhConvention convention) {
  const Eigen::Isometry3d about_z = pose(turn_z(row.theta), {0.0, 0.0, row.d});
  const Eigen::Isometry3d about_x = pose(turn_x(row.alpha), {row.a, 0.0, 0.0});
  return convention == DhConvention::standard ? about_z * about_x : about_x * about_z;
}

const char* key_of(DhConvention convention) { return convention == DhConvention::standard ? "dh" : "mdh"; }

void refuse_other_placement(const Robot& robot, const TomlTable& table, const std::vector<TomlTable>& joints,
                            const std::string& row) {
  if (table.has("axes"))
    table.fail(
        "axes",
        fmt::format("is given together with {0} in [[joint]]; leave out axes, or {0} in every joint", row));
  for (const TomlTable& joint : joints)
    for (const char* key : {"axis", "offset", "direction"})
      if (joint.has(key))
        joint.fail(key, fmt::format("is given together with {}; give only one of them", row));
  if (std::find(robot.shapes.begin(), robot.shapes.end(), LinkShape::rod) != robot.shapes.end())
    table.fail(
        "link",
        fmt::format("has the shape \"rod\", but {} does not describe rods; expected \"general\" or \"point\"",
                    row));
  const auto says_length = [](const auto& fact) { return fact.first[0] == 'l'; };
  if (std::any_of(robot.known.begin(), robot.known.end(), says_length) ||
      std::any_of(robot.chain.length.begin(), robot.chain.length.end(), [](double l) { return l != 0.0; }))
    table.fail(
        "",
        fmt::format("gives a length together with {}, which already places all joints; leave it out", row));
}

DhRow read_row(const TomlTable& joint, DhConvention convention) {
  const char* other =
      key_of(convention == DhConvention::standard ? DhConvention::modified : DhConvention::standard);
  if (joint.has(other))
    joint.fail(other, fmt::format("is mixed with {}; use one convention", key_of(convention)));
  if (!joint.has(key_of(convention)))
    joint.fail("", fmt::format(
                       "has no {0}, but other joints have; give {0} = {{a, alpha, d, theta}} for every joint",
                       key_of(convention)));
  const TomlTable row = joint.table(key_of(convention));
  return {row.number("a", 0.0), row.number("alpha", 0.0), row.number("d", 0.0), row.number("theta", 0.0)};
}

}  // namespace

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

bool has_dh_row(const TomlTable& joint) { return joint.has("dh") || joint.has("mdh"); }

Robot read_dh(const TomlTable& table, const std::vector<TomlTable>& joints, Robot robot) {
  const auto first = std::find_if(joints.begin(), joints.end(), has_dh_row);
  if (first == joints.end()) return robot;
  const auto convention = first->has("dh") ? DhConvention::standard : DhConvention::modified;
  refuse_other_placement(robot, table, joints, key_of(convention));
  std::vector<AxisKind> kinds;
  std::vector<DhRow> rows;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    kinds.push_back(robot.chain.geometry[i].kind);
    rows.push_back(read_row(joints[i], convention));
  }
  const DhGeometry geometry = dh_geometry(kinds, rows, convention);
  robot.chain.geometry = geometry.joints;
  return with_tip(std::move(robot), geometry.tip);
}

}  // namespace faultline
