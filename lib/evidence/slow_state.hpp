// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lib/robot/chain.hpp"

namespace faultline {

/// What differs between one healthy day of a robot and another, and wanders within a day.
enum class SlowKind {
  friction,         ///< share by which a joint's viscous and Coulomb friction is more than identified
  torque_gain,      ///< share by which the drive gives more torque than logged
  torque_offset,    ///< N m or N that the drive gives beside what is logged
  coloured_torque,  ///< N m or N that the model misses for a while: ripple, springs, shape of friction
  tip_mass,         ///< kg carried beside what was identified
};

inline constexpr double kStdsInRange = 2.0;  ///< standard deviations of days on either side (NormalRange)
inline constexpr int kSlowKinds = static_cast<int>(SlowKind::tip_mass) + 1;

/// The name used in models, such as "torque_gain".
const char* to_string(SlowKind kind);
/// Throws Error(input) when `name` is none of them; `where` names the file.
SlowKind slow_kind_from(const std::string& name, const std::string& where);

/// One number of the healthy robot that is carried in the state of every filter, healthy or faulty, and is 0
/// for the robot that was identified.
struct SlowState {
  SlowKind kind = SlowKind::friction;
  int joint = 0;          ///< from 0; the last one for the tip
  double day_std = 0.0;   ///< how far days differ; of a coloured torque its level at any time
  double walk = 0.0;      ///< what it wanders by in a second, grows with the root of time
  double memory_s = 0.0;  ///< of a coloured torque: it is forgotten in this time; 0 for what stays
  double usual = 0.0;     ///< what it wanders around: another value once a fault has changed it

  /// Normal days are within +- this.
  double normal_range() const { return kStdsInRange * day_std; }
};

inline constexpr int kMaxSlowStates = (kSlowKinds - 1) * kMaxJoints + 1;

}  // namespace faultline
