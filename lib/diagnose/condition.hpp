// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <limits>
#include <string>
#include <vector>

#include "lib/core/joint.hpp"
#include "lib/explain/day/day_effects.hpp"
#include "lib/robot/chain.hpp"

namespace faultline {

/// An effect of the day, by which a healthy robot may differ from the identified one, as a log shows it.
struct ConditionItem {
  std::string name;  ///< stable identifier, such as "friction_1"
  std::string what;  ///< for a person, such as "friction of joint 1"
  Joint joint{};
  double value = std::numeric_limits<double>::quiet_NaN();
  std::array<double, 2> ci95 = {value, value};
  double normal_range = std::numeric_limits<double>::quiet_NaN();  ///< healthy days lie within +- this
  std::string unit;  ///< "%", "N m" or "N", of all numbers above
  DayEffectKind kind = DayEffectKind::friction;

  /// Whether the log determines the value better than the normal range does: its interval is narrower.
  bool is_determined() const { return 0.5 * (ci95[1] - ci95[0]) < normal_range; }
  /// Whether the whole interval lies outside `ranges` times the normal range.
  bool is_beyond(double ranges = 1.0) const {
    return ci95[0] > ranges * normal_range || ci95[1] < -ranges * normal_range;
  }
};

/// Converts the effects of a day, in the same order; shares become percent of the identified value.
std::vector<ConditionItem> condition_of(const std::vector<DayEffect>& day, const Chain& chain);

/// Lists the items beyond `ranges` times their normal range, such as "friction of joint 1 (+52 %, normal
/// within 30 %)"; empty if there are none.
std::string beyond_normal(const std::vector<ConditionItem>& condition, double ranges = 1.0);

/// A value with its sign and unit in three significant digits, such as "+5.13 %".
std::string condition_value_text(double value, const std::string& unit);

}  // namespace faultline
