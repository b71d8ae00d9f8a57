// SPDX-License-Identifier: MIT
#pragma once

#include "lib/core/joint.hpp"

namespace faultline {

/// Effects by which the healthy days of a robot differ.
enum class DayEffectKind {
  friction,       ///< relative excess of a joint's friction over the identified one
  torque_gain,    ///< relative excess of the drive's torque over the logged one
  torque_offset,  ///< N m or N that the drive adds to the logged torque
  torque_ripple,  ///< amplitude, N m or N, of a torque that repeats with the position of the joint
};

/// Returns the name for reports, such as "torque_gain".
inline const char* to_string(DayEffectKind kind) {
  switch (kind) {
    case DayEffectKind::friction:
      return "friction";
    case DayEffectKind::torque_gain:
      return "torque_gain";
    case DayEffectKind::torque_offset:
      return "torque_offset";
    case DayEffectKind::torque_ripple:
      return "torque_ripple";
  }
  return "";
}

/// Estimate of an effect of the day of a log; 0 is the identified robot.
struct DayEffect {
  DayEffectKind kind = DayEffectKind::friction;
  Joint joint{};
  double value = 0.0;
  double std = 0.0;      ///< of the estimate
  double day_std = 0.0;  ///< standard deviation between healthy days

  /// Returns the bound of the effect on normal days, on either side of 0.
  double normal_range() const { return kStdsInRange * day_std; }

  static constexpr double kStdsInRange = 2.0;  ///< standard deviations of healthy days on either side
};

}  // namespace faultline
