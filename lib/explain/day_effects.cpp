// SPDX-License-Identifier: MIT
#include "lib/explain/day_effects.hpp"

namespace faultline {

const char* to_string(DayEffectKind kind) {
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

}  // namespace faultline
