// SPDX-License-Identifier: MIT
#include "lib/robot/robot_words.hpp"

namespace faultline {

const char* to_string(AxisKind kind) { return kind == AxisKind::revolute ? "revolute" : "prismatic"; }

const char* to_string(LinkShape shape) {
  switch (shape) {
    case LinkShape::rod:
      return "rod";
    case LinkShape::point:
      return "point";
    case LinkShape::general:
      return "general";
  }
  return "";
}

const char* to_string(TorqueMeaning meaning) {
  switch (meaning) {
    case TorqueMeaning::commanded:
      return "commanded";
    case TorqueMeaning::measured:
      return "measured";
    case TorqueMeaning::current:
      return "current";
  }
  return "";
}

const char* logged_words(TorqueMeaning meaning) {
  return meaning == TorqueMeaning::current ? "from motor current" : to_string(meaning);
}

const char* to_string(TorqueTiming timing) {
  switch (timing) {
    case TorqueTiming::held:
      return "held";
    case TorqueTiming::linear:
      return "linear";
    case TorqueTiming::unknown:
      return "unknown";
  }
  return "";
}

}  // namespace faultline
