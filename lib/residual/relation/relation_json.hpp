// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "lib/residual/relation/signal_relation.hpp"

namespace faultline {

nlohmann::json relations_to_json(const std::vector<SignalRelation>& relations);
/// Reads relations. Throws Error(input), which names `where`, for those that do not fit together or are not
/// of a robot with `joints` joints, and what nlohmann::json throws.
std::vector<SignalRelation> relations_from_json(const nlohmann::json& list, int joints,
                                                const std::string& where);

}  // namespace faultline
