// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/robot/robot.hpp"

namespace faultline {

/// Names of the parameters that a robot file may state: m1.., l1.., fv1.. and so on (see Robot::known).
std::vector<std::string> parameter_names(int joints);

/// Sets the parameter `name` in `robot.chain` without adding it to `robot.known`. The mass of a general link
/// scales its whole inertia. Returns false if the robot has no such parameter.
bool set_parameter(Robot& robot, const std::string& name, double value);

}  // namespace faultline
