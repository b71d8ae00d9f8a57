// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "lib/log/log.hpp"
#include "lib/robot/chain.hpp"

namespace faultline {

/// Something else that the columns of a log may mean than the robot file says.
struct ColumnReading {
  std::string what;                                ///< in a sentence's words, such as "q2 is in degrees"
  std::string cure;                                ///< what to write where, an order
  std::function<void(Log&)> apply;                 ///< makes of a log what it says if that is so
  std::function<void(Chain&)> of_robot = nullptr;  ///< what the robot file would say instead; none: as it is
};

/// Units, signs, and swapped columns of single joints, of all angles and of the time.
std::vector<ColumnReading> column_readings(const Chain& chain);
/// Units of all torques or of all sliding axes, and swapped joints: what shows only where the robot is known.
std::vector<ColumnReading> common_readings(const Chain& chain);
/// Other directions of gravity, or none.
std::vector<ColumnReading> gravity_readings(const Chain& chain);

}  // namespace faultline
