// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>

#include "lib/fault/fault_catalogue.hpp"
#include "lib/robot/toml/toml_table.hpp"

namespace faultline {

/// Smallest change of each kind that is reported as a fault ([least_size] of the robot file), as a share of
/// the usual value of the joint or the robot (usual_of()); 0 reports any size. The defaults are those of the
/// catalogue (FaultDescription::least_size).
struct LeastSizes {
  std::array<double, kFaultKinds> share;

  LeastSizes();
  double of(FaultKind kind) const { return share[static_cast<std::size_t>(kind)]; }
  bool operator==(const LeastSizes&) const = default;
};

/// Reads [least_size]; absent keys keep their defaults. Fails as TomlTable does.
LeastSizes least_sizes_from_table(const TomlTable& table);
/// Returns the section [least_size]; "" if all sizes have their defaults.
std::string least_sizes_text(const LeastSizes& sizes);

/// How far a healthy robot may deviate from the identified one, on another day and within a day ([normal] of
/// the robot file). The defaults suit an ordinary machine; learning widens a range if the healthy logs show a
/// wider one. Ranges are two standard deviations to either side.
struct NormalRange {
  double friction = 0.3;          ///< share of each joint's friction: temperature, grease, load
  double torque_constant = 0.02;  ///< share of the drive's torque: temperature of the magnets
  double torque_offset = 0.01;    ///< share of the largest torque
  /// Least error of the equations of motion, as a share of the largest torque, correlated over some
  /// hundredths of a second: ripple, springs, friction of another shape, time stamps late by a sample.
  double model_error = 0.005;
  std::array<double, 2> noise = {0.5, 2.0};  ///< factors on the measurement noise of the healthy logs
  double work_piece_kg = 0.0;  ///< mass that is picked up and put down; 0: estimated from the logs

  bool operator==(const NormalRange&) const = default;
};

/// Reads [normal]; absent keys keep their defaults. Fails as TomlTable does.
NormalRange normal_range_from_table(const TomlTable& normal);
/// Returns the section [normal]; "" if all ranges have their defaults.
std::string normal_range_text(const NormalRange& normal);

}  // namespace faultline
