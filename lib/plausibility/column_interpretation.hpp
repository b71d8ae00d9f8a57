// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "lib/log/log.hpp"
#include "lib/robot/chain.hpp"

namespace faultline {

/// An alternative interpretation of the columns of a log, other than by the robot file.
struct ColumnInterpretation {
  std::string what;                                ///< in words inside a sentence, such as "q2 is in degrees"
  std::string cure;                                ///< what to write where, as an instruction
  std::function<void(Log&)> apply;                 ///< converts a log to this interpretation
  std::function<void(Chain&)> of_robot = nullptr;  ///< changes the robot; null: not changed
  bool is_entry_of_columns = false;                ///< the cure is an entry of [log.columns] alone
};

/// Returns other units, signs and swapped columns of single joints, other units of all angles and the time.
std::vector<ColumnInterpretation> column_interpretations(const Chain& chain);
/// Returns other units of several joints, swapped and reversed joints: detectable if the robot is known.
std::vector<ColumnInterpretation> common_interpretations(const Chain& chain);
/// Returns gravity along another axis, or none: an arm on its side, hanging, or moving horizontally.
std::vector<ColumnInterpretation> gravity_interpretations(const Chain& chain);

}  // namespace faultline
