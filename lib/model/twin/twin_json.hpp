// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "lib/model/twin/twin_options.hpp"

namespace faultline {

/// Returns every number and, under "faults", the ranges of each kind that has a size.
nlohmann::ordered_json twin_to_json(const TwinOptions& options);
/// Throws Error(input) if something is missing or no number; `where` names the file. Kinds that are not
/// listed keep the catalogue's ranges.
TwinOptions twin_from_json(const nlohmann::ordered_json& json, const std::string& where);

}  // namespace faultline
