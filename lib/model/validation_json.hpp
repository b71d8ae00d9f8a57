// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "lib/model/model.hpp"

namespace faultline {

nlohmann::json validation_to_json(const Validation& validation);
/// Throws what nlohmann::json throws, and Error(usage) for an unknown kind.
Validation validation_from_json(const nlohmann::json& json);

}  // namespace faultline
