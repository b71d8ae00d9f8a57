// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "lib/robot/robot.hpp"

namespace faultline {

/// Throws Error(input) when a number in the JSON of a model, wherever it stands, is beyond what it can be;
/// the message names the place, the number and its bounds.
void check_model_ranges(const nlohmann::json& model, const std::string& where);

/// The same of the robot that stands in a model as text: lengths, masses, inertias, friction.
void check_robot_ranges(const Robot& robot, const std::string& where);

/// True when the table of ranges names this place ("/motion/q_std/*", a star for each place in a list), so
/// that more is known of it than that it is a number.
bool has_model_range(const std::string& place);

}  // namespace faultline
