// SPDX-License-Identifier: MIT
#include "lib/simulate/gears.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "lib/robot/dynamics.hpp"
#include "lib/simulate/joint_list.hpp"

namespace faultline {
namespace {

double value_of(const std::vector<double>& list, int j) { return list.empty() ? 0.0 : list[j]; }

constexpr double kLeastInertia = 1e-9;  // kg m^2 or kg; less counts as none, as it needs too short a step

/// Throws Error(usage) if a link behind a spring has no inertia of its own.
void check_links(const Chain& chain, const Gears& gears) {
  const JointMatrix inertia =
      inertia_matrix(gears.link_side(chain), JointVector(JointVector::Zero(chain.joints())));
  const JointMatrix mobility = inertia.inverse();
  for (int j = 0; j < chain.joints(); ++j)
    if (gears.has_spring(j) && !(1.0 / mobility(j, j) > kLeastInertia))
      bad_value(
          "gears.stiffness",
          fmt::format("joint {} has no inertia behind its gear; expected stiffness 0, or a link with inertia",
                      Joint::at(j)));
}

}  // namespace

Robot with_motors(Robot robot, const GearSpec& spec) {
  for (int j = 0; j < robot.joints(); ++j) {
    const double inertia = value_of(spec.motor_inertia, j);
    if (!(inertia > 0.0)) continue;
    if (robot.chain.rotor_inertia.empty()) robot.chain.rotor_inertia.assign(robot.joints(), 0.0);
    robot.chain.rotor_inertia[j] = inertia;
  }
  return robot;
}

void check_gears(const Robot& robot, const GearSpec& spec) {
  const int joints = robot.joints();
  check_not_negative(joints, spec.stiffness, "gears.stiffness");
  check_not_negative(joints, spec.damping, "gears.damping");
  check_not_negative(joints, spec.play, "gears.play");
  check_not_negative(joints, spec.motor_inertia, "gears.motor_inertia");
  const Chain chain = with_motors(robot, spec).chain;
  for (int j = 0; j < joints; ++j) {
    if (!(value_of(spec.stiffness, j) > 0.0)) {
      const bool plays = value_of(spec.play, j) > 0.0;
      if (plays || value_of(spec.damping, j) > 0.0)
        bad_value(
            plays ? "gears.play" : "gears.damping",
            fmt::format("the gear of joint {} is rigid; expected 0 here, or a stiffness", Joint::at(j)));
      continue;
    }
    if (!(value_of(chain.rotor_inertia, j) > 0.0))
      bad_value(
          "gears.motor_inertia",
          fmt::format("the gear of joint {0} is a spring; expected the inertia of the motor behind it, here "
                      "or as jr{0} of the robot",
                      Joint::at(j)));
    for (const SharedDrive& drive : chain.shared_drives)
      if (drive.along[j] != 0.0)
        bad_value("gears.stiffness",
                  fmt::format("a shared drive turns joint {}; expected 0 for this joint", Joint::at(j)));
  }
  check_links(chain, Gears(chain, spec));
}

Gears::Gears(const Chain& chain, const GearSpec& spec)
    : stiffness_(or_all(spec.stiffness, chain.joints(), 0.0)),
      damping_(or_all(spec.damping, chain.joints(), 0.0)),
      play_(or_all(spec.play, chain.joints(), 0.0)),
      motor_inertia_(or_all(chain.rotor_inertia, chain.joints(), 0.0)) {
  for (int j = 0; j < chain.joints(); ++j)
    if (stiffness_[j] > 0.0) springs_ |= 1u << j;
}

double Gears::torque(int j, double twist, double rate) const {
  const double half = 0.5 * play_[j];
  const double wound = twist > half ? twist - half : std::min(twist + half, 0.0);
  const double torque = stiffness_[j] * wound + damping_[j] * rate;
  if (!(half > 0.0)) return torque;
  if (wound == 0.0) return 0.0;
  return wound > 0.0 ? std::max(torque, 0.0) : std::min(torque, 0.0);
}

double Gears::twist_under(int j, double torque) const {
  if (torque == 0.0) return 0.0;
  return torque / stiffness_[j] + std::copysign(0.5 * play_[j], torque);
}

Chain Gears::link_side(Chain chain) const {
  for (int j = 0; j < chain.joints(); ++j) {
    if (!has_spring(j)) continue;
    chain.friction[j] = {};
    chain.rotor_inertia[j] = 0.0;
  }
  std::erase_if(chain.ripples, [this](const Ripple& ripple) { return has_spring(ripple.joint.index()); });
  return chain;
}

double Gears::vibration_rate(const JointVector& link_mobility) const {
  double square = 0.0;  // trace of K (M^-1 + J^-1), which is at least its largest eigenvalue
  for (int j = 0; j < link_mobility.size(); ++j)
    if (has_spring(j)) square += stiffness_[j] * (link_mobility[j] + 1.0 / motor_inertia_[j]);
  return std::sqrt(square);
}

double Gears::damping_rate(const JointVector& link_mobility) const {
  double rate = 0.0;
  for (int j = 0; j < link_mobility.size(); ++j)
    if (has_spring(j)) rate += damping_[j] * (link_mobility[j] + 1.0 / motor_inertia_[j]);
  return rate;
}

}  // namespace faultline
