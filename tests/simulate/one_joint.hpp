// SPDX-License-Identifier: MIT
#pragma once

#include "lib/robot/robot.hpp"

/// A single joint whose motion is known in closed form: a rod that turns about the vertical, without
/// friction.
namespace faultline {

constexpr double kRodInertia = 4.0 * 0.3 * 0.3 / 3.0;  // of a rod of 4 kg and 0.3 m about its end, kg m^2

inline Robot one_joint() {
  Robot robot = preset_robot("R");
  robot = with_masses_and_lengths(robot, {4.0}, {0.3});
  robot.chain.friction = {{}};
  return robot;
}

inline JointVector one(double value) { return JointVector::Constant(1, value); }

}  // namespace faultline
