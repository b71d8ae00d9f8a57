// SPDX-License-Identifier: MIT
#pragma once

#include "lib/robot/robot.hpp"

/// The words of a robot file, read and written.
namespace faultline {

const char* to_string(AxisKind kind);
const char* to_string(LinkShape shape);
const char* to_string(TorqueMeaning meaning);
/// How a logged torque came about, for legends: "commanded", "measured", "from motor current".
const char* logged_words(TorqueMeaning meaning);
const char* to_string(TorqueTiming timing);

}  // namespace faultline
