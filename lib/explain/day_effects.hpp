// SPDX-License-Identifier: MIT
#pragma once

namespace faultline {

/// What differs between one healthy day of a robot and another.
enum class DayEffectKind {
  friction,       ///< share by which a joint's friction is more than identified
  torque_gain,    ///< share by which the drive gives more torque than logged
  torque_offset,  ///< N m or N that the drive gives beside what is logged
};

/// The name used in reports, such as "torque_gain".
inline const char* to_string(DayEffectKind kind) {
  switch (kind) {
    case DayEffectKind::friction:
      return "friction";
    case DayEffectKind::torque_gain:
      return "torque_gain";
    case DayEffectKind::torque_offset:
      return "torque_offset";
  }
  return "";
}

/// What a log tells of an effect of its day: 0 is the robot that was identified.
struct DayEffect {
  DayEffectKind kind = DayEffectKind::friction;
  int joint = 0;  ///< from 1
  double value = 0.0;
  double std = 0.0;      ///< of the estimate
  double day_std = 0.0;  ///< how far healthy days differ

  /// Normal days are within +- this.
  double normal_range() const { return kStdsInRange * day_std; }

  static constexpr double kStdsInRange = 2.0;  ///< standard deviations of healthy days on either side
};

}  // namespace faultline
