// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "lib/fault/fault_size.hpp"
#include "lib/log/log_source.hpp"
#include "lib/robot/chain.hpp"

namespace faultline {

/// How large faults of a robot usually are, SI units, one number a joint: what features divide sizes by.
struct UsualSizes {
  std::vector<double> bias;              ///< rad or m
  std::vector<double> drift;             ///< rad/s or m/s
  std::vector<double> viscous_increase;  ///< N m s/rad or N s/m
  std::vector<double> coulomb_increase;  ///< N m or N
  std::vector<double> external_torque;   ///< N m or N, of a push
  double payload = 0.0;                  ///< kg
};

/// How a robot moves in its healthy logs, one number a joint.
struct UsualMotion {
  std::vector<double> q_low, q_high;   ///< range, rad or m
  std::vector<double> velocity_scale;  ///< root mean square of the velocity, rad/s or m/s
  std::vector<double> torque_scale;    ///< largest torque, N m or N
  UsualSizes sizes;

  int joints() const { return static_cast<int>(q_low.size()); }
};

/// The usual motion of the identified robot in its healthy logs. Throws Error(input) when the logs hold too
/// few rows.
UsualMotion usual_motion(std::span<LogSource* const> logs, const Chain& chain);

/// What a size of this measure at joint `j` (from 0) is divided by to become a feature of an episode; 1 for a
/// share of torque.
double feature_scale(const UsualMotion& usual, SizeMeasure measure, int j);

/// What sizes of this measure are drawn and reported as shares of (usual_of() in words): the range of the
/// joint, its usual friction, the mass carried, its largest torque; 1 for a share of torque.
double usual_size(const UsualMotion& usual, SizeMeasure measure, int j);

}  // namespace faultline
