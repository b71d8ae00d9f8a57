// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "lib/core/issue.hpp"

namespace faultline {

/// Its texts as they are; what a file holds may be no valid UTF-8.
nlohmann::ordered_json issue_json(const Issue& issue);

}  // namespace faultline
