// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "lib/identify/usual_motion.hpp"

namespace faultline {

nlohmann::json usual_motion_to_json(const UsualMotion& usual);
/// Throws Error(input) when a key is missing or the lists do not have one number for each of `joints`.
UsualMotion usual_motion_from_json(const nlohmann::json& json, int joints, const std::string& where);

}  // namespace faultline
