// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>

#include "lib/robot/toml/toml_table.hpp"

namespace faultline {

/// How far a healthy robot may be from the one that was identified, on another day and within a day ([normal]
/// of the robot file). The defaults suit an ordinary machine; learning widens what its healthy logs show to
/// be wider. Ranges are two standard deviations to either side.
struct NormalRange {
  double friction = 0.3;          ///< share of each joint's friction: temperature, grease, load
  double torque_constant = 0.02;  ///< share of the drive's torque: temperature of the magnets
  double torque_offset = 0.01;    ///< share of the largest torque
  /// Share of the largest torque that the equations of motion miss at the least, for some hundredths of a
  /// second each time: ripple, springs, friction of another shape, stamps a sample late.
  double model_error = 0.005;
  std::array<double, 2> noise = {0.5, 2.0};  ///< times the measurement noise of the healthy logs
  double work_piece_kg = 0.0;  ///< mass that is picked up and put down; 0 to learn whether one is

  bool operator==(const NormalRange&) const = default;
};

/// [normal]; what it leaves out keeps its default. Fails as TomlTable does.
NormalRange normal_range_from_table(const TomlTable& normal);
/// [normal]; "" where all is as by default.
std::string normal_range_text(const NormalRange& normal);

}  // namespace faultline
