// SPDX-License-Identifier: MIT
#pragma once

#include "lib/robot/robot.hpp"

/// The words that a robot file uses for enumerations.
namespace faultline {

const char* to_string(AxisKind kind);
const char* to_string(LinkShape shape);
const char* to_string(TorqueMeaning meaning);
/// Origin of a logged torque in words for legends: "commanded", "measured", "from motor current".
const char* logged_words(TorqueMeaning meaning);
const char* to_string(TorqueTiming timing);

}  // namespace faultline
