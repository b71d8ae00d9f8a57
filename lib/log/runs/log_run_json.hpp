// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "lib/log/log_run.hpp"

namespace faultline {

/// Returns the run as a JSON object, the same in reports of every kind.
nlohmann::ordered_json log_run_json(const LogRun& run);

}  // namespace faultline
