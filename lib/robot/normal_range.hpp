// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

namespace faultline {

/// How far a healthy robot may be from the one that was identified, on another day and within a day. The
/// defaults suit an ordinary machine; learning widens what its healthy logs show to be wider. Ranges are
/// two standard deviations to either side.
struct NormalRange {
  double friction = 0.3;          ///< share of each joint's friction: temperature, grease, load
  double friction_pace = 0.02;    ///< share of it by which it wanders in a second, with the root of time
  double torque_constant = 0.02;  ///< share of the drive's torque: temperature of the magnets
  double torque_offset = 0.01;    ///< share of the largest torque
  double tip_mass = 0.02;         ///< share of what the robot carries: tools, hoses
  std::array<double, 2> noise = {0.5, 2.0};  ///< times the measurement noise of the healthy logs
};

}  // namespace faultline
