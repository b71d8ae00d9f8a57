// SPDX-License-Identifier: MIT
#include "lib/robot/urdf/urdf_more.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "lib/core/text.hpp"
#include "lib/robot/robot.hpp"
#include "lib/robot/robot_file_parts.hpp"
#include "lib/robot/toml/toml_values.hpp"

namespace faultline {
namespace {

constexpr double kSameBody = 1e-13;  ///< relative error up to which a body counts as converted back

template <typename Of>
std::string each_joint(const Robot& robot, const char* key, Of of) {
  Eigen::VectorXd values(robot.joints());
  for (int i = 0; i < robot.joints(); ++i) values[i] = of(i);
  return fmt::format("{} = {}\n", key, toml_numbers(values));
}

std::string more_link(const Robot& robot, int i) {
  const LinkInertia& link = robot.chain.links[i];
  std::string text = fmt::format("\n[[link]]\nshape = \"{}\"\nlength = {}\n", to_string(robot.shapes[i]),
                                 toml_number(robot.chain.length[i]));
  const Eigen::Vector3d& direction = robot.chain.geometry[i].direction;
  if (!direction.isZero()) text += fmt::format("direction = {}\n", toml_numbers(direction));
  if (!about_centre(link).converts_back)
    text += fmt::format("first_moment = {}\ninertia_at_joint = {}\n", toml_numbers(link.first_moment),
                        toml_tensor(link.inertia));
  return text;
}

/// Reads rotor inertias and friction. Identified rotor inertias may be negative: the split is not
/// identifiable.
Robot read_friction(const TomlTable& table, Robot robot) {
  const int n = robot.joints();
  if (table.has("rotor_inertia")) robot.chain.rotor_inertia = table.each("rotor_inertia", n);
  if (!robot.identified) check_signs(table, "rotor_inertia", robot.chain.rotor_inertia, true);
  const TomlTable friction = table.table("friction");
  const auto set = [&](const char* key, double Friction::*member, bool any_sign) {
    set_friction(friction, key, member, any_sign, robot.chain);
  };
  if (friction.has("offset")) set("offset", &Friction::offset, true);
  if (friction.has("width")) set("width", &Friction::width, false);
  if (friction.has("load")) set("load", &Friction::load, true);
  if (!friction.has("bend")) return robot;
  set("bend", &Friction::bend, true);
  set("skew", &Friction::skew, true);
  set("bend_width", &Friction::bend_width, false);
  return robot;
}

Robot read_axes(const TomlTable& table, Robot robot) {
  robot.axes = table.text("axes", "");
  std::string kinds;
  for (const JointGeometry& joint : robot.chain.geometry)
    kinds += joint.kind == AxisKind::revolute ? 'R' : 'P';
  if (!robot.axes.empty() && robot.axes != kinds)
    table.fail("axes", fmt::format("expected \"{}\", as the joints of the file are, found \"{}\"", kinds,
                                   printable(robot.axes)));
  return robot;
}

/// Moves a part of the joints' offsets into lengths and directions; the joints keep their places.
Robot read_more_links(const TomlTable& table, Robot robot) {
  const auto links = table.tables("link");
  if (static_cast<int>(links.size()) != robot.joints())
    table.fail("link", fmt::format("expected one [[link]] for each of the {} moving joints of the file, "
                                   "found {}; if joints were added or removed, leave out <faultline>",
                                   robot.joints(), links.size()));
  for (int i = 0; i < robot.joints(); ++i) {
    const TomlTable& link = links[i];
    robot.shapes[i] = link.choice_of("shape", {LinkShape::rod, LinkShape::point, LinkShape::general});
    robot.chain.length[i] = link.number("length", 0.0);
    JointGeometry& joint = robot.chain.geometry[i];
    joint.direction.setZero();
    if (link.has("direction") && i > 0) {
      joint.direction = unit_vector(link, "direction", {0, 0, 0});
      joint.offset -= robot.chain.length[i - 1] * joint.direction;
    }
    if (!link.has("first_moment")) continue;
    robot.chain.links[i].first_moment = vector3(link, "first_moment", {0, 0, 0});
    robot.chain.links[i].inertia = inertia_tensor(link, "inertia_at_joint");
  }
  return robot;
}

}  // namespace

CentredBody about_centre(const LinkInertia& link) {
  if (link.mass == 0.0) return {Eigen::Vector3d::Zero(), link.inertia, link.first_moment.isZero(0.0)};
  const Eigen::Vector3d centre = link.first_moment / link.mass;
  const Eigen::Matrix3d inertia =
      link.inertia - general_body(link.mass, centre, Eigen::Matrix3d::Zero()).inertia;
  const LinkInertia again = general_body(link.mass, centre, inertia);
  const bool same = (again.inertia - link.inertia).norm() <= kSameBody * link.inertia.norm() &&
                    (again.first_moment - link.first_moment).norm() <= kSameBody * link.first_moment.norm();
  if (same && centre.allFinite() && inertia.allFinite()) return {centre, inertia, true};
  return {Eigen::Vector3d::Zero(), link.inertia, false};
}

std::string urdf_more_text(const Robot& robot) {
  const Chain& chain = robot.chain;
  std::string text = fmt::format("name = {}\n", toml_quoted(robot.name));
  if (!robot.axes.empty()) text += fmt::format("axes = {}\n", toml_quoted(robot.axes));
  text += fmt::format("gravity = {}\n", toml_numbers(chain.gravity));
  text += each_joint(robot, "rotor_inertia", [&](int i) { return chain.rotor_inertia[i]; });
  text += fmt::format("identified = {}\n", robot.identified);
  if (robot.torque_phi) text += fmt::format("torque_phi = {}\n", toml_number(*robot.torque_phi));
  text += drive_text(robot);
  text += "\n[friction]\n";
  text += each_joint(robot, "offset", [&](int i) { return chain.friction[i].offset; });
  text += each_joint(robot, "width", [&](int i) { return chain.friction[i].width; });
  if (std::any_of(chain.friction.begin(), chain.friction.end(),
                  [](const Friction& f) { return f.bend != 0.0 || f.skew != 0.0; })) {
    text += each_joint(robot, "bend", [&](int i) { return chain.friction[i].bend; });
    text += each_joint(robot, "skew", [&](int i) { return chain.friction[i].skew; });
    text += each_joint(robot, "bend_width", [&](int i) { return chain.friction[i].bend_width; });
  }
  if (std::any_of(chain.friction.begin(), chain.friction.end(),
                  [](const Friction& f) { return f.load != 0.0; }))
    text += each_joint(robot, "load", [&](int i) { return chain.friction[i].load; });
  text += extra_torque_text(chain, "");
  for (int i = 0; i < robot.joints(); ++i) text += more_link(robot, i);
  return text + facts_text(robot);
}

Robot read_urdf_more(const std::string& text, const std::string& where, Robot robot) {
  const TomlTable table = TomlTable::parse(text, where);
  robot.name = table.text("name", robot.name);
  robot.chain.gravity = vector3(table, "gravity", robot.chain.gravity);
  robot.identified = table.flag("identified", false);
  robot = read_friction(table, std::move(robot));
  robot.chain = read_extra_torque(table, std::move(robot.chain));
  robot = read_drives(table, std::move(robot));
  if (table.has("torque_phi")) robot.torque_phi = table.number("torque_phi");
  robot = read_axes(table, std::move(robot));
  robot = read_more_links(table, std::move(robot));
  const Chain chain = robot.chain;
  robot = read_known(table, std::move(robot));
  if (robot.identified) robot.chain = chain;  // identified values take precedence over known ones
  robot.log = log_meaning_from_table(table.table("log"), robot.joints());
  robot.normal = normal_range_from_table(table.table("normal"));
  robot.least_sizes = least_sizes_from_table(table.table("least_size"));
  table.finish();
  return robot;
}

}  // namespace faultline
