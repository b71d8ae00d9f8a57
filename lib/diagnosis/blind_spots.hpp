// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/robot/robot.hpp"

namespace faultline {

/// What a log cannot show, a sentence each, by what its torque means and whether it has velocities.
std::vector<std::string> blind_spots(TorqueMeaning torque, bool has_velocity);

}  // namespace faultline
