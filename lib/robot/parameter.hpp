// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/robot/robot.hpp"

namespace faultline {

/// Names of the parameters a robot file may state: m1.., l1.., fv1.., fc1.., fo1.., jr1.. (see Robot::known).
std::vector<std::string> parameter_names(int joints);

/// Sets one of them in `robot.chain`; does not add it to `robot.known`. The mass of a general link scales its
/// whole inertia. False when the robot has no such parameter.
bool set_parameter(Robot& robot, const std::string& name, double value);

}  // namespace faultline
