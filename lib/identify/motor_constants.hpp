// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "lib/core/issue.hpp"
#include "lib/core/joint.hpp"
#include "lib/identify/weak_form/weak_windows.hpp"

namespace faultline {

/// Torque per unit of motor current of each joint, in units of the torque per unit of current of the
/// reference joint: logs of currents alone do not determine the scale of all masses.
struct MotorConstants {
  Joint reference = 1_joint;
  std::vector<double> constant;     ///< by joint; negative where the current counts against the axis
  std::vector<double> uncertainty;  ///< relative standard error by joint; 0 at the reference
  std::vector<bool> sign_is_known;  ///< by joint: the logs exclude the opposite sign
};

/// Estimates the constants from the masses that joints share: joint j draws the current
///   i_j = c_j (Y_j theta + friction_j),   constant_j = 1 / c_j,
/// with one theta for all joints; friction opposes the motion and the inertia of each joint is positive.
/// Returns nothing if joints that move are fewer than two, or if equal constants explain the currents
/// about as well.
std::optional<MotorConstants> motor_constants(const WeakSets& windows);

/// Returns a note with the constants for a report.
Issue motor_constants_issue(const MotorConstants& constants);

}  // namespace faultline
