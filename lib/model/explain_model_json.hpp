// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "lib/explain/explain_log.hpp"

namespace faultline {

/// What explains the logs of a robot, every bit kept both ways.
nlohmann::json explain_model_to_json(const ExplainModel& model);
/// Throws Error(input) when members do not fit together, and what nlohmann::json throws.
ExplainModel explain_model_from_json(const nlohmann::json& json, const std::string& where);

}  // namespace faultline
