// SPDX-License-Identifier: MIT
#include "lib/diagnose/condition_words.hpp"

#include "lib/explain/day/day_effects.hpp"

namespace faultline {
namespace {

const char* words_of(DayEffectKind kind) {
  switch (kind) {
    case DayEffectKind::friction:
      return "friction";
    case DayEffectKind::torque_gain:
      return "drive torque";
    case DayEffectKind::torque_offset:
      return "torque offset";
    case DayEffectKind::torque_ripple:
      return "torque ripple";
  }
  return "";
}

}  // namespace

std::string condition_words(const std::string& name) {
  for (const DayEffectKind kind : {DayEffectKind::friction, DayEffectKind::torque_gain,
                                   DayEffectKind::torque_offset, DayEffectKind::torque_ripple}) {
    const std::string begin = std::string(to_string(kind)) + "_";
    const std::string joint = name.starts_with(begin) ? name.substr(begin.size()) : "";
    if (!joint.empty() && joint.find_first_not_of("0123456789") == std::string::npos)
      return std::string(words_of(kind)) + " of joint " + joint;
  }
  return name;
}

}  // namespace faultline
