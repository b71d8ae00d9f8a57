// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>

#include "lib/identify/identification.hpp"

namespace faultline {

/// Adds what the residual repeats with, what the motion excites and the trends of the parameters.
void add_verdicts(const Identification& identification, nlohmann::ordered_json& document);
/// Reads them back; documents of older versions have none.
void read_verdicts(const nlohmann::ordered_json& document, Identification& identification);

}  // namespace faultline
