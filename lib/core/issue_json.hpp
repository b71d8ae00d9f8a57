// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "lib/core/issue.hpp"

namespace faultline {

/// Returns the issue with its texts unchanged; those from a file may be invalid UTF-8.
nlohmann::ordered_json issue_json(const Issue& issue);

}  // namespace faultline
