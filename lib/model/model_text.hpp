// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "lib/explain/explain_log.hpp"
#include "lib/robot/robot.hpp"

/// The frame of a model file: JSON whose last member is the SHA-256 of all bytes before it.

namespace faultline {

inline constexpr int kModelVersion = 4;

/// "faultline/model/4"
std::string model_schema(int version);

/// Returns a model as file text with its digest. `content` has no digest.
std::string sealed_model_text(const nlohmann::ordered_json& content);

/// Throws Error(input) if the text is no JSON, no model, of another schema, or does not fit its digest.
nlohmann::json read_model_text(const std::string& text, const std::string& where);

/// Returns the text with a digest that fits and a note that it was edited and `why`; returns a text with a
/// fitting digest unchanged. Throws Error(input) if it is no JSON or no model; model_from_json() checks the
/// content.
std::string signed_model_text(const std::string& text, const std::string& why, const std::string& where);

/// Throws Error(input) if a number anywhere in the JSON of a model is beyond its range; the message names the
/// place, the number and its bounds.
void check_model_ranges(const nlohmann::json& model, const std::string& where);

/// Throws Error(input) likewise for the robot in a model: places, lengths, masses, inertias, friction.
void check_robot_ranges(const Robot& robot, const std::string& where);

/// Whether the table of ranges contains this place ("/motion/q_std/*", a star for each place in a list), so
/// that its number has a range of its own.
bool has_model_range(const std::string& place);

/// Returns the model that explains the logs of a robot as JSON, without loss of a bit both ways.
nlohmann::json explain_model_to_json(const ExplainModel& model);
/// Throws Error(input) if members do not fit together, and the exceptions of nlohmann::json.
ExplainModel explain_model_from_json(const nlohmann::json& json, const std::string& where);

}  // namespace faultline
