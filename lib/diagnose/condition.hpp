// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <limits>
#include <string>
#include <vector>

#include "lib/explain/day_effects.hpp"
#include "lib/robot/chain.hpp"

namespace faultline {

/// A number by which a healthy robot may differ from the one that was identified, as a log shows it.
struct ConditionItem {
  std::string name;  ///< stable identifier, such as "friction_1"
  std::string what;  ///< for a person, such as "friction of joint 1"
  int joint = 0;     ///< from 1
  double value = std::numeric_limits<double>::quiet_NaN();
  std::array<double, 2> ci95 = {value, value};
  double normal_range = std::numeric_limits<double>::quiet_NaN();  ///< healthy days are within +- so much
  std::string unit;  ///< "%" of what was identified, "N m" or "N"

  /// Whether the log tells it better than the normal range does.
  bool is_told() const { return 0.5 * (ci95[1] - ci95[0]) < normal_range; }
  /// Whether the whole interval lies outside the normal range, or so many times it.
  bool is_beyond(double ranges = 1.0) const {
    return ci95[0] > ranges * normal_range || ci95[1] < -ranges * normal_range;
  }
};

/// In the order in which they are.
std::vector<ConditionItem> condition_of(const std::vector<DayEffect>& day, const Chain& chain);

/// What is beyond its normal range, or so many times it, such as "friction of joint 1 (+52 %, normal within
/// 30 %)"; empty if nothing is.
std::string beyond_normal(const std::vector<ConditionItem>& condition, double ranges = 1.0);

/// "+5.13 %", in three significant digits.
std::string condition_value_text(double value, const std::string& unit);

}  // namespace faultline
