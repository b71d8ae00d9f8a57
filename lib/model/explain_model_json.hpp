// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "lib/explain/explain_log.hpp"

namespace faultline {

/// Returns the model that explains the logs of a robot as JSON, without loss of a bit both ways.
nlohmann::json explain_model_to_json(const ExplainModel& model);
/// Throws Error(input) if members do not fit together, and the exceptions of nlohmann::json.
ExplainModel explain_model_from_json(const nlohmann::json& json, const std::string& where);

}  // namespace faultline
