// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "lib/evidence/motion_model.hpp"
#include "lib/robot/robot.hpp"

namespace faultline {

/// All of the model but its chain and torque timing, which belong to the robot; numbers keep every bit.
void to_json(nlohmann::json& json, const MotionModel& model);
/// Throws Error(input) when something is missing or not one number a joint; `where` names the file.
MotionModel motion_model_from_json(const nlohmann::json& json, const Robot& robot, const std::string& where);

}  // namespace faultline
