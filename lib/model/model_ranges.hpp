// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "lib/robot/robot.hpp"

namespace faultline {

/// Throws Error(input) if a number anywhere in the JSON of a model is beyond its range; the message names the
/// place, the number and its bounds.
void check_model_ranges(const nlohmann::json& model, const std::string& where);

/// Throws Error(input) likewise for the robot in a model: places, lengths, masses, inertias, friction.
void check_robot_ranges(const Robot& robot, const std::string& where);

/// Whether the table of ranges contains this place ("/motion/q_std/*", a star for each place in a list), so
/// that its number has a range of its own.
bool has_model_range(const std::string& place);

}  // namespace faultline
