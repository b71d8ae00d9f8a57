// SPDX-License-Identifier: MIT
#include "lib/identify/base_candidates.hpp"

#include <fmt/format.h>

#include <string>

namespace faultline {
namespace {

BaseCandidate candidate(const std::string& name, const std::string& unit, int joints) {
  return {{name, unit, name}, Eigen::VectorXd::Zero(joints * (kLinkParameters + 1))};
}

LinkVector rod_inertia(const Eigen::Vector3d& direction) {
  LinkInertia<double> link;
  link.inertia = Eigen::Matrix3d::Identity() - direction * direction.transpose();
  return to_vector(link);
}

/// The inertial numbers of link i that its shape leaves free, the ones that carry most first.
void add_link_candidates(const Robot& robot, int i, std::vector<BaseCandidate>& out) {
  const int n = robot.joints(), at = i * kLinkParameters;
  const auto add = [&](const std::string& name, const std::string& unit, const LinkVector& v) {
    out.push_back(candidate(name + std::to_string(i + 1), unit, n));
    out.back().direction.segment<kLinkParameters>(at) = v;
  };
  const auto unit_vector = [](int k) { return LinkVector(LinkVector::Unit(k)); };
  if (robot.shapes[i] == LinkShape::rod) {
    const Eigen::Vector3d along = link_direction(robot, i);
    LinkVector moment = LinkVector::Zero();
    moment.segment<3>(1) = along;
    add("I", "kg m^2", rod_inertia(along));
    add("mx", "kg m", moment);
  } else if (robot.shapes[i] == LinkShape::general) {
    const char* const inertia[] = {"Izz", "Ixx", "Iyy", "Ixy", "Ixz", "Iyz"};
    const int index[] = {6, 4, 5, 7, 8, 9};
    for (int k = 0; k < 6; ++k) add(inertia[k], "kg m^2", unit_vector(index[k]));
    add("mx", "kg m", unit_vector(1));
    add("my", "kg m", unit_vector(2));
    add("mz", "kg m", unit_vector(3));
  }
  add("m", "kg", unit_vector(0));
  out.back().parameter.is_mass = true;
}

/// What turns with the motor: felt by its own joint alone.
void add_rotor_candidate(const Robot& robot, int i, std::vector<BaseCandidate>& out) {
  const bool turns = robot.chain.geometry[i].kind == AxisKind::revolute;
  BaseCandidate c = candidate("jr" + std::to_string(i + 1), turns ? "kg m^2" : "kg", robot.joints());
  c.parameter.is_rotor = true;
  c.direction[robot.joints() * kLinkParameters + i] = 1.0;
  c.parameter.joint = i;
  out.push_back(std::move(c));
}

/// a, b, c, m3 of physics of the SCARA: each direction changes that one number of M and G and no other.
std::vector<BaseCandidate> scara_candidates(const Robot& robot) {
  const int n = robot.joints();
  const double l1 = robot.chain.length[0], l2 = robot.chain.length[1];
  const Eigen::Vector3d x1 = link_direction(robot, 0), x2 = link_direction(robot, 1);
  const bool tool = n > 3;
  const std::string carried = tool ? "(m3 + m4)" : "m3";
  BaseCandidate a = candidate("a", "kg m^2", n), b = candidate("b", "kg m^2", n),
                c = candidate("c", "kg m^2", n);
  BaseCandidate m = candidate("m3", "kg", n);
  a.parameter.meaning = fmt::format("l1^2 (m1/3 + m2 + {})", carried);
  b.parameter.meaning = fmt::format("l2^2 (m2/3 + {})", carried);
  c.parameter.meaning = fmt::format("l1 l2 (m2/2 + {})", carried);
  m.parameter.meaning = tool ? "m3 + m4" : "m3";
  m.parameter.is_mass = true;
  a.direction.segment<kLinkParameters>(0) = rod_inertia(x1);
  b.direction.segment<kLinkParameters>(kLinkParameters) = rod_inertia(x2);
  c.direction.segment<3>(kLinkParameters + 1) = x2 / l1;
  m.direction[2 * kLinkParameters] = 1.0;
  m.direction -= l1 * l1 * a.direction + l2 * l2 * b.direction + l1 * l2 * c.direction;
  return {a, b, c, m};
}

}  // namespace

bool is_scara(const Robot& robot) { return robot.axes == "RRP" || robot.axes == "RRPR"; }

std::vector<BaseCandidate> base_candidates(const Robot& robot) {
  std::vector<BaseCandidate> out;
  if (is_scara(robot) && robot.chain.length[0] > 0.0 && robot.chain.length[1] > 0.0)
    out = scara_candidates(robot);
  for (int i = 0; i < robot.joints(); ++i) add_link_candidates(robot, i, out);
  for (int i = 0; i < robot.joints(); ++i)
    if (robot.known.count("jr" + std::to_string(i + 1)) == 0) add_rotor_candidate(robot, i, out);
  return out;
}

}  // namespace faultline
