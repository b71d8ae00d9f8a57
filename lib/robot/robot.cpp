// SPDX-License-Identifier: MIT
#include "lib/robot/robot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

#include "lib/core/error.hpp"

namespace faultline {
namespace {

// Share of the way from one logged torque to the next (phi): a smaller one is nearer to a held torque, phi =
// 0, than to a torque that changes many times on the way, phi = 1/2.
constexpr double kNearlyHeld = 0.25;

/// Whether the last R directly after a P, behind an arm of two or more R, is a tool's wrist, as in RRPR.
bool ends_in_wrist(const std::string& axes) {
  return axes.ends_with("PR") && std::count(axes.begin(), axes.end(), 'R') > 2;
}

constexpr std::pair<const char*, double Friction::*> kFrictionTerms[] = {
    {"fv", &Friction::viscous}, {"fc", &Friction::coulomb}, {"fo", &Friction::offset},
    {"fb", &Friction::bend},    {"fs", &Friction::skew},    {"fl", &Friction::load}};

}  // namespace

bool is_order_of_axes(const std::string& text) {
  return !text.empty() && text.size() <= kMaxJoints && text.find_first_not_of("RP") == std::string::npos;
}

Robot preset_robot(const std::string& axes) {
  if (!is_order_of_axes(axes))
    throw Error(ErrorCode::usage, "axes",
                fmt::format("\"{}\" is not an order of parallel axes; expected 1 to {} letters R (turns "
                            "about z) and P (slides along z) from base to tip, such as RRP, RRPR, RPRR or "
                            "RR; describe other chains axis by axis",
                            axes, kMaxJoints));
  Robot robot;
  robot.name = axes;
  robot.axes = axes;
  const auto count = axes.size();
  for (std::size_t i = 0; i < count; ++i) {
    JointGeometry joint;
    joint.kind = axes[i] == 'R' ? AxisKind::revolute : AxisKind::prismatic;
    // A prismatic axis carries the next joint on its own line, also the tool's wrist (a last R after P).
    if (i == 0 || axes[i - 1] == 'P') joint.direction.setZero();
    robot.chain.geometry.push_back(joint);
    robot.shapes.push_back(i + 1 == count && ends_in_wrist(axes) ? LinkShape::general
                           : axes[i] == 'R'                      ? LinkShape::rod
                                                                 : LinkShape::point);
  }
  robot.chain.links.resize(count);
  robot.chain.friction.resize(count);
  robot.chain.rotor_inertia.assign(count, 0.0);
  robot.chain.length.assign(count, 1.0);
  robot = with_masses_and_lengths(std::move(robot), std::vector<double>(count, 1.0),
                                  std::vector<double>(count, 1.0));
  for (std::size_t i = 0; i < count; ++i) {
    if (robot.shapes[i] != LinkShape::rod) robot.chain.length[i] = 0.0;
    if (robot.shapes[i] == LinkShape::general)
      robot.chain.links[i] = general_body(1.0, Eigen::Vector3d::Zero(), 0.01 * Eigen::Matrix3d::Identity());
  }
  return robot;
}

Eigen::Vector3d link_direction(const Robot& robot, int i) {
  const auto& geometry = robot.chain.geometry;
  const Eigen::Vector3d& direction = geometry[std::min(i + 1, robot.joints() - 1)].direction;
  return direction.isZero() ? Eigen::Vector3d::UnitX() : direction;
}

Robot with_tip(Robot robot, const Eigen::Vector3d& tip) {
  const double reach = tip.norm();
  JointGeometry& last = robot.chain.geometry.back();
  if (reach == 0.0 || last.kind == AxisKind::prismatic) return robot;
  const Eigen::Vector3d direction = tip / reach;
  if (robot.joints() > 1)
    last.direction = direction;  // the link before has no length: the joint does not move
  else if (direction != Eigen::Vector3d::UnitX())
    return robot;
  robot.chain.length.back() = reach;
  return robot;
}

Robot with_masses_and_lengths(Robot robot, const std::vector<double>& masses,
                              const std::vector<double>& lengths) {
  for (int i = 0; i < robot.joints(); ++i) {
    robot.chain.length[i] = lengths[i];
    if (robot.shapes[i] == LinkShape::rod)
      robot.chain.links[i] = uniform_rod(masses[i], lengths[i], link_direction(robot, i));
    else if (robot.shapes[i] == LinkShape::point)
      robot.chain.links[i] = point_mass(masses[i]);
  }
  return robot;
}

const char* to_string(AxisKind kind) { return kind == AxisKind::revolute ? "revolute" : "prismatic"; }

const char* to_string(LinkShape shape) {
  static constexpr std::array kNames{"rod", "point", "general"};
  static_assert(kNames.size() == static_cast<std::size_t>(LinkShape::general) + 1);
  return kNames[static_cast<std::size_t>(shape)];
}

const char* to_string(TorqueMeaning meaning) {
  static constexpr std::array kNames{"commanded", "measured", "current"};
  static_assert(kNames.size() == static_cast<std::size_t>(TorqueMeaning::current) + 1);
  return kNames[static_cast<std::size_t>(meaning)];
}

const char* logged_words(TorqueMeaning meaning) {
  return meaning == TorqueMeaning::current ? "from motor current" : to_string(meaning);
}

const char* to_string(TorqueTiming timing) {
  static constexpr std::array kNames{"held", "linear", "unknown"};
  static_assert(kNames.size() == static_cast<std::size_t>(TorqueTiming::unknown) + 1);
  return kNames[static_cast<std::size_t>(timing)];
}

TorqueTiming torque_between_samples(const Robot& robot) {
  const TorqueTiming stated = robot.log.torque_between_samples;
  if (stated != TorqueTiming::unknown || !robot.torque_phi) return stated;
  return *robot.torque_phi < kNearlyHeld ? TorqueTiming::held : TorqueTiming::linear;
}

std::vector<std::string> parameter_names(int joints) {
  std::vector<std::string> names;
  for (const char* prefix : {"m", "l", "fv", "fc", "fo", "fb", "fs", "fl", "jr"})
    for (int j = 0; j < joints; ++j) names.push_back(fmt::format("{}{}", prefix, Joint::at(j)));
  return names;
}

bool set_parameter(Robot& robot, const std::string& name, double value) {
  const std::size_t digits = name.find_first_of("0123456789");
  int number = 0;
  if (digits == std::string::npos || digits == 0) return false;
  const auto [end, error] = std::from_chars(name.data() + digits, name.data() + name.size(), number);
  if (error != std::errc() || end != name.data() + name.size() || number < 1 || number > robot.joints())
    return false;
  const std::string what = name.substr(0, digits);
  const int i = Joint::numbered(number).index();
  Chain& chain = robot.chain;
  LinkInertia& link = chain.links[i];
  for (const auto& [prefix, term] : kFrictionTerms) {
    if (what != prefix) continue;
    chain.friction[i].*term = value;
    return true;
  }
  if (what == "jr")
    chain.rotor_inertia[i] = value;
  else if (what == "l")
    chain.length[i] = value;
  else if (what != "m")
    return false;
  if (robot.shapes[i] == LinkShape::rod && (what == "m" || what == "l")) {
    link = uniform_rod(what == "m" ? value : link.mass, chain.length[i], link_direction(robot, i));
  } else if (robot.shapes[i] == LinkShape::point && what == "m") {
    link = point_mass(value);
  } else if (what == "m") {  // a general body keeps its shape: everything scales with the mass
    const double ratio = link.mass > 0.0 ? value / link.mass : 0.0;
    link = {value, ratio * link.first_moment, ratio * link.inertia};
  }
  return true;
}

}  // namespace faultline
