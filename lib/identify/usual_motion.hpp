// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "lib/fault/fault_catalogue.hpp"
#include "lib/log/log_source.hpp"
#include "lib/robot/chain.hpp"

namespace faultline {

/// Usual sizes of faults of a robot, SI units, one number a joint: features divide sizes by them.
struct UsualSizes {
  std::vector<double> bias;              ///< rad or m
  std::vector<double> drift;             ///< rad/s or m/s
  std::vector<double> viscous_increase;  ///< N m s/rad or N s/m
  std::vector<double> coulomb_increase;  ///< N m or N
  std::vector<double> external_torque;   ///< N m or N, of a collision
  double payload = 0.0;                  ///< kg
};

/// Motion of a robot in its healthy logs, one number a joint.
struct UsualMotion {
  std::vector<double> q_low, q_high;   ///< range, rad or m
  std::vector<double> velocity_scale;  ///< root mean square of the velocity, rad/s or m/s
  std::vector<double> torque_scale;    ///< largest torque, N m or N
  UsualSizes sizes;

  int joints() const { return static_cast<int>(q_low.size()); }
};

/// Returns the usual motion of the identified robot in its healthy logs. Throws Error(input) if the logs have
/// too few rows.
UsualMotion usual_motion(std::span<LogSource* const> logs, const Chain& chain);

/// Returns the divisor that makes a size of this measure at joint `j` (from 0) a feature of an episode; 1 for
/// a share of torque.
double feature_scale(const UsualMotion& usual, SizeMeasure measure, int j);

/// Returns the quantity that sizes of this measure are drawn and reported as shares of (usual_of() in words):
/// range of the joint, usual friction, mass carried, largest torque or its impulse; 1 for a share of torque.
double usual_size(const UsualMotion& usual, SizeMeasure measure, int j);

}  // namespace faultline
