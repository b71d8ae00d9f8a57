// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <span>
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
  bool is_other_torque_unit = false;               ///< one torque is multiplied by a positive number
};

/// Returns other units, signs and swapped columns of single joints, other units of all angles and the time.
std::vector<ColumnInterpretation> column_interpretations(const Chain& chain);
/// Returns other units of several joints, swapped and reversed joints, then column_interpretations(). The
/// former are detectable if the robot is known.
std::vector<ColumnInterpretation> interpretations_by_known_robot(const Chain& chain);
/// Returns gravity along another axis, or none: an arm on its side, hanging, or moving horizontally.
std::vector<ColumnInterpretation> gravity_interpretations(const Chain& chain);
/// Returns the interpretation that the stamps of `rows` run too fast or too slow and a row is `period_s`
/// after the one before; none if it nearly is.
std::vector<ColumnInterpretation> clock_interpretations(const Log& rows, double period_s);
/// Returns torques logged late or early by two rows to a quarter of `rows`, in steps of a third.
std::vector<ColumnInterpretation> delay_interpretations(const Log& rows);

/// Returns a number that is less the better logs are explained under an interpretation, in which they are
/// given; nullopt if they are not explained.
using InterpretationScore =
    std::function<std::optional<double>(const ColumnInterpretation&, const std::vector<Log>&)>;

/// Returns the interpretation with the least score below `limit`, null if there is none. An interpretation
/// under which a joint moves by less than `least_motion` (by joint, rad or m), but more than that in `logs`,
/// has no score: little motion needs no torque, so that any robot explains it.
const ColumnInterpretation* best_interpretation(std::span<const ColumnInterpretation> interpretations,
                                                const std::vector<Log>& logs,
                                                const std::vector<double>& least_motion, double limit,
                                                const InterpretationScore& score);

}  // namespace faultline
