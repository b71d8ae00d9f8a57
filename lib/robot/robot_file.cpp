// SPDX-License-Identifier: MIT
#include "lib/robot/robot_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <tuple>
#include <utility>

#include "lib/core/atomic_file.hpp"
#include "lib/core/error.hpp"
#include "lib/robot/dh/denavit_hartenberg.hpp"
#include "lib/robot/nearest_word.hpp"
#include "lib/robot/robot.hpp"
#include "lib/robot/robot_file_parts.hpp"
#include "lib/robot/toml/toml_values.hpp"
#include "lib/robot/urdf/urdf.hpp"

namespace faultline {
namespace {

constexpr double kMostLoad = 0.9;  // highest share of a drive's torque that load friction may take
constexpr double kFastest = 1e5;   // highest rate of a ripple, 1/rad or 1/m

/// Builds a chain without `axes`: every axis from its [[joint]] table.
Robot chain_from_joints(const TomlTable& table, const std::vector<TomlTable>& joints) {
  if (joints.empty())
    table.fail(
        "",
        fmt::format(
            "does not give the axes; expected axes = \"RRP\" (base to tip) or one [[joint]] table per axis{}",
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

/// Reads axis, offset and direction from the tables of the joints that give them.
Robot read_geometry(const std::vector<TomlTable>& joints, Robot robot) {
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
  return robot;
}

Robot read_link(const TomlTable& table, int i, Robot robot) {
  if (table.has("shape")) {
    robot.shapes[i] = table.choice_of("shape", {LinkShape::rod, LinkShape::point, LinkShape::general});
  } else if (table.has("inertia") || table.has("centre") || table.has("inertia_at_joint")) {
    robot.shapes[i] = LinkShape::general;
  }
  robot.chain.length[i] = not_negative(table, "length", robot.shapes[i] == LinkShape::rod ? 1.0 : 0.0);
  const double mass = not_negative(table, "mass", 1.0);
  LinkInertia& link = robot.chain.links[i];
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
  return robot;
}

/// Reads [[link]]: lengths, masses and shapes; without [[link]], keeps those of `axes` or sets defaults.
Robot read_links(const TomlTable& table, Robot robot) {
  const auto links = table.tables("link");
  if (!links.empty() && static_cast<int>(links.size()) != robot.joints())
    table.fail("link", fmt::format("expected one [[link]] for each of the {} joints, base to tip, found {}",
                                   robot.joints(), links.size()));
  if (links.empty() && robot.chain.length.empty()) {  // a chain given axis by axis: unit masses and lengths
    robot.chain.length.assign(robot.joints(), 0.0);
    for (int i = 0; i < robot.joints(); ++i) robot = read_link(TomlTable::parse("", ""), i, std::move(robot));
  }
  robot.chain.length.resize(robot.joints(), 0.0);
  for (std::size_t i = 0; i < links.size(); ++i)
    robot = read_link(links[i], static_cast<int>(i), std::move(robot));
  return robot;
}

void check_load(const TomlTable& table, const std::string& key, double load) {
  if (load >= kMostLoad)
    table.fail(key, fmt::format("expected a share of the torque below {}, found {}", kMostLoad, load));
}

Robot read_friction(const TomlTable& table, const std::vector<TomlTable>& joints, Robot robot) {
  const int n = robot.joints();
  const TomlTable friction = table.table("friction");
  if (table.has("width")) set_friction(table, "width", &Friction::width, false, robot.chain);
  for (const auto& [key, member, any_sign] : {std::tuple{"viscous", &Friction::viscous, false},
                                              {"coulomb", &Friction::coulomb, false},
                                              {"offset", &Friction::offset, true},
                                              {"width", &Friction::width, false},
                                              {"bend", &Friction::bend, true},
                                              {"bend_width", &Friction::bend_width, false},
                                              {"skew", &Friction::skew, true},
                                              {"load", &Friction::load, false}})
    if (friction.has(key)) set_friction(friction, key, member, any_sign, robot.chain);
  for (const Friction& f : robot.chain.friction) check_load(friction, "load", f.load);
  if (table.has("rotor_inertia")) {
    robot.chain.rotor_inertia = table.each("rotor_inertia", n);
    check_signs(table, "rotor_inertia", robot.chain.rotor_inertia, true);
  }
  for (std::size_t i = 0; i < joints.size(); ++i) {
    Friction& f = robot.chain.friction[i];
    const TomlTable own = joints[i].table("friction");
    f.viscous = not_negative(own, "viscous", f.viscous);
    f.coulomb = not_negative(own, "coulomb", f.coulomb);
    f.offset = own.number("offset", f.offset);
    f.width = positive(own, "width", f.width);
    f.bend = own.number("bend", f.bend);
    f.bend_width = positive(own, "bend_width", f.bend_width);
    f.skew = own.number("skew", f.skew);
    f.load = not_negative(own, "load", f.load);
    check_load(own, "load", f.load);
    robot.chain.rotor_inertia[i] = not_negative(joints[i], "rotor_inertia", robot.chain.rotor_inertia[i]);
  }
  return robot;
}

KnownValue known_value(const TomlTable& table, const std::string& key) {
  if (!table.is_table(key)) return {table.number(key), 0.0};
  const TomlTable fact = table.table(key);
  return {fact.number("value"), not_negative(fact, "std", 0.0)};
}

Robot read_identified(const TomlTable& table, Robot robot) {
  robot.identified = table.has("identified");
  const TomlTable identified = table.table("identified");
  if (!robot.identified) return robot;
  if (identified.has("torque_phi")) robot.torque_phi = identified.number("torque_phi");
  robot = read_drives(identified, std::move(robot));
  const auto joints = identified.tables("joint");
  if (static_cast<int>(joints.size()) != robot.joints())
    identified.fail("joint",
                    fmt::format("expected one [[identified.joint]] for each of the {} joints, found {}",
                                robot.joints(), joints.size()));
  for (int i = 0; i < robot.joints(); ++i) {
    const TomlTable& joint = joints[i];
    Chain& chain = robot.chain;
    chain.length[i] = joint.number("length");
    chain.links[i].mass = joint.number("mass");
    chain.links[i].first_moment = vector3(joint, "first_moment", {0, 0, 0});
    chain.links[i].inertia = inertia_tensor(joint, "inertia");
    chain.friction[i] = {joint.number("viscous"),
                         joint.number("coulomb"),
                         joint.number("offset"),
                         positive(joint, "width", 0.01),
                         joint.number("bend", 0.0),
                         joint.number("skew", 0.0),
                         positive(joint, "bend_width", 1.0),
                         joint.number("load", 0.0)};
    chain.rotor_inertia[i] = joint.number("rotor_inertia", 0.0);
  }
  robot.chain.ripples.clear();
  robot.chain.shared_drives.clear();
  robot.chain = read_extra_torque(identified, std::move(robot.chain));
  return robot;
}

/// Whether the text begins with "<", as no TOML does.
bool is_xml(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r\n");
  return first != std::string::npos && text[first] == '<';
}

}  // namespace

void set_friction(const TomlTable& table, const std::string& key, double Friction::*member, bool any_sign,
                  Chain& chain) {
  const auto values = table.each(key, chain.joints());
  if (!any_sign) check_signs(table, key, values, !key.ends_with("width"));
  for (int i = 0; i < chain.joints(); ++i) chain.friction[i].*member = values[i];
}

Chain read_extra_torque(const TomlTable& table, Chain chain) {
  const int n = chain.joints();
  for (const TomlTable& ripple : table.tables("ripple")) {
    const auto joint = ripple.integer("joint", 0);
    if (joint < 1 || joint > n)
      ripple.fail("joint", fmt::format("expected a joint from 1 to {}, found {}", n, joint));
    const double rate = ripple.number("rate");
    if (!(rate > 0.0 && rate <= kFastest))
      ripple.fail("rate", fmt::format("expected a number above 0 and up to {}, found {}", kFastest, rate));
    chain.ripples.push_back({Joint::numbered(static_cast<int>(joint)), rate, ripple.number("cosine", 0.0),
                             ripple.number("sine", 0.0)});
  }
  for (const TomlTable& shared : table.tables("shared_drive")) {
    const auto along = shared.numbers("along", n);
    if (n - std::count(along.begin(), along.end(), 0.0) < 2)
      shared.fail("along", "expected a drive that turns with two joints or more: two numbers that are not 0");
    chain.shared_drives.push_back({Eigen::Map<const Eigen::VectorXd>(along.data(), n),
                                   not_negative(shared, "viscous", 0.0), not_negative(shared, "coulomb", 0.0),
                                   positive(shared, "width", 0.01),
                                   not_negative(shared, "rotor_inertia", 0.0)});
  }
  return chain;
}

Robot read_drives(const TomlTable& table, Robot robot) {
  const auto read = [&](const char* key, std::vector<double>& values) {
    if (table.has(key)) values = table.each(key, robot.joints());
  };
  read("torque_delay_s", robot.torque_delay_s);
  read("torque_gain", robot.torque_gain);
  read("torque_limit", robot.torque_limit);
  check_signs(table, "torque_limit", robot.torque_limit, true);
  read("gear_compliance", robot.gear_compliance);
  return robot;
}

Robot read_known(const TomlTable& table, Robot robot) {
  const TomlTable known = table.table("known");
  const auto names = parameter_names(robot.joints());
  for (const std::string& key : known.keys()) {
    if (std::find(names.begin(), names.end(), key) == names.end()) {
      const std::string near = nearest_word(key, names);
      known.fail(
          key, fmt::format("is not a parameter of this robot; expected m, l, fv, fc, fo, fb, fs, fl or jr "
                           "with a joint from 1 to {}{}",
                           robot.joints(), near.empty() ? "" : fmt::format("; did you mean \"{}\"?", near)));
    }
    const KnownValue fact = known_value(known, key);
    const std::string kind = key.substr(0, 2);
    if (fact.value < 0.0 && kind != "fo" && kind != "fb" && kind != "fs")
      known.fail(key, fmt::format("expected a number that is not negative, found {}", fact.value));
    if (kind == "fl") check_load(known, key, fact.value);
    robot.known[key] = fact;
    set_parameter(robot, key, fact.value);
  }
  const TomlTable payload = table.table("payload");
  for (const std::string& key : payload.keys()) robot.payloads[key] = known_value(payload, key);
  return robot;
}

Robot robot_from_table(const TomlTable& table) {
  const auto joints = table.tables("joint");
  Robot robot;
  if (table.has("axes")) {
    const std::string axes = table.text("axes");
    try {
      robot = preset_robot(axes);
    } catch (const Error& error) {
      table.fail("axes", error.message() + " in [[joint]] tables");
    }
    if (!joints.empty() && static_cast<int>(joints.size()) != robot.joints())
      table.fail("joint",
                 fmt::format("expected no [[joint]] or one for each of the {} axes of \"{}\", found {}",
                             robot.joints(), axes, joints.size()));
  } else {
    robot = chain_from_joints(table, joints);
  }
  robot.name = table.text("name", robot.axes.empty() ? "robot" : robot.axes);
  robot.chain.gravity = vector3(table, "gravity", robot.chain.gravity);
  robot = read_geometry(joints, std::move(robot));
  robot = read_links(table, std::move(robot));
  robot = read_friction(table, joints, std::move(robot));
  robot.chain = read_extra_torque(table, std::move(robot.chain));
  robot = read_known(table, std::move(robot));
  robot = read_dh(table, joints, std::move(robot));
  robot.log = log_meaning_from_table(table.table("log"), robot.joints());
  robot.normal = normal_range_from_table(table.table("normal"));
  robot.least_sizes = least_sizes_from_table(table.table("least_size"));
  return read_identified(table, std::move(robot));
}

Robot robot_from_toml(const std::string& text, const std::string& where) {
  const TomlTable table = TomlTable::parse(text, where);
  Robot robot = robot_from_table(table);
  table.finish();
  return robot;
}

Robot load_robot_file(const std::string& name, const std::string& folder) {
  const std::string path = (std::filesystem::path(folder) / name).string();
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) {
    if (is_order_of_axes(name)) return preset_robot(name);
    if (name.find_first_of("./") == std::string::npos)
      throw Error(ErrorCode::input, path,
                  "is not a file; expected a robot file, or the axes alone as letters R and P, base to tip, "
                  "such as RRP");
  }
  if (has_urdf_name(path)) return load_urdf_file(path);
  const std::string text = read_file(path);
  if (is_xml(text)) return robot_from_urdf(text, path);
  refuse_open_number(text, path);
  return robot_from_toml(text, path);
}

std::string robot_text_for(const std::string& path, const Robot& robot) {
  return has_urdf_name(path) ? urdf_text(robot) : robot_file_text(robot);
}

}  // namespace faultline
