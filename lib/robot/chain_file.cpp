// SPDX-License-Identifier: MIT
#include "lib/robot/chain_file.hpp"

#include <fmt/format.h>

#include <string>

#include "lib/robot/dh/dh_file.hpp"
#include "lib/robot/robot_words.hpp"
#include "lib/robot/toml/toml_values.hpp"

namespace faultline {
namespace {

void read_link(Robot& robot, int i, const TomlTable& table) {
  if (table.has("shape")) {
    robot.shapes[i] = table.choice_of("shape", {LinkShape::rod, LinkShape::point, LinkShape::general});
  } else if (table.has("inertia") || table.has("centre") || table.has("inertia_at_joint")) {
    robot.shapes[i] = LinkShape::general;
  }
  robot.chain.length[i] = not_negative(table, "length", robot.shapes[i] == LinkShape::rod ? 1.0 : 0.0);
  const double mass = not_negative(table, "mass", 1.0);
  LinkInertia<double>& link = robot.chain.links[i];
  if (robot.shapes[i] == LinkShape::rod) {
    link = uniform_rod(mass, robot.chain.length[i], link_direction(robot, i));
  } else if (robot.shapes[i] == LinkShape::point) {
    link = point_mass(mass);
  } else if (table.has("inertia_at_joint")) {
    link.mass = mass;
    link.first_moment = vector3(table, "first_moment", {0, 0, 0});
    link.inertia = inertia_tensor(table, "inertia_at_joint");
  } else {
    const bool stated = table.has("inertia");
    link = general_body(
        mass, vector3(table, "centre", {0, 0, 0}),
        stated ? inertia_tensor(table, "inertia") : Eigen::Matrix3d(0.01 * Eigen::Matrix3d::Identity()));
  }
}

}  // namespace

Robot chain_from_joints(const TomlTable& table, const std::vector<TomlTable>& joints) {
  if (joints.empty())
    table.fail(
        "", fmt::format("says nothing about the axes; expected axes = \"RRP\" (base to tip) or one [[joint]] "
                        "table an axis{}",
                        table.has("axis") ? "; the key is \"axes\", not \"axis\"" : ""));
  if (joints.size() > kMaxJoints)
    table.fail("joint", fmt::format("expected at most {} joints, found {}", kMaxJoints, joints.size()));
  Robot robot;
  for (const TomlTable& joint : joints) {
    JointGeometry geometry;
    geometry.kind = joint.choice_of("kind", {AxisKind::revolute, AxisKind::prismatic});
    const bool dh = has_dh_row(joint);
    const bool on_last_axis = dh || robot.chain.geometry.empty() || joint.has("offset") ||
                              robot.chain.geometry.back().kind == AxisKind::prismatic;
    if (on_last_axis) geometry.direction.setZero();
    robot.chain.geometry.push_back(geometry);
    robot.shapes.push_back(dh                                    ? LinkShape::general
                           : geometry.kind == AxisKind::revolute ? LinkShape::rod
                                                                 : LinkShape::point);
  }
  const std::size_t n = joints.size();
  robot.chain.links.resize(n);
  robot.chain.friction.resize(n);
  robot.chain.rotor_inertia.assign(n, 0.0);
  return robot;
}

void read_geometry(Robot& robot, const std::vector<TomlTable>& joints) {
  for (std::size_t i = 0; i < joints.size(); ++i) {
    JointGeometry& geometry = robot.chain.geometry[i];
    geometry.axis = unit_vector(joints[i], "axis", geometry.axis);
    geometry.offset = vector3(joints[i], "offset", geometry.offset);
    if (joints[i].has("direction"))
      geometry.direction = i == 0 ? vector3(joints[i], "direction", {0, 0, 0})
                                  : unit_vector(joints[i], "direction", geometry.direction);
    if (i == 0 && !geometry.direction.isZero())
      joints[i].fail("direction", "the first joint has no link before it; place it with offset");
    if (joints[i].has("kind") &&
        joints[i].choice_of("kind", {AxisKind::revolute, AxisKind::prismatic}) != geometry.kind)
      joints[i].fail("kind", fmt::format("contradicts axes = \"{}\", in which this joint is {}", robot.axes,
                                         to_string(geometry.kind)));
  }
}

void read_links(Robot& robot, const TomlTable& table) {
  const auto links = table.tables("link");
  if (!links.empty() && static_cast<int>(links.size()) != robot.joints())
    table.fail("link", fmt::format("expected one [[link]] for each of the {} joints, base to tip, found {}",
                                   robot.joints(), links.size()));
  if (links.empty() && robot.chain.length.empty()) {  // a chain given axis by axis: unit masses and lengths
    robot.chain.length.assign(robot.joints(), 0.0);
    for (int i = 0; i < robot.joints(); ++i) read_link(robot, i, TomlTable::parse("", ""));
  }
  robot.chain.length.resize(robot.joints(), 0.0);
  for (std::size_t i = 0; i < links.size(); ++i) read_link(robot, static_cast<int>(i), links[i]);
}

}  // namespace faultline
