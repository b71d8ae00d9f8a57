// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "lib/identify/identification.hpp"

namespace faultline {

/// Returns the identification as a document of schema faultline/identification/1: results for users and
/// scripts, and under `state` all that identification_from_json needs to restore the same value (robot,
/// estimate, covariance), bit for bit.
nlohmann::ordered_json to_json(const Identification& identification);

/// Throws Error(input) naming `where` if the document is not ours, of another schema or incomplete.
Identification identification_from_json(const nlohmann::ordered_json& document, const std::string& where);

/// The same without `state`, for display only: what is read back has no robot, estimate or covariance.
nlohmann::ordered_json summary_to_json(const Identification& identification);
Identification summary_from_json(const nlohmann::ordered_json& document, const std::string& where);

}  // namespace faultline
