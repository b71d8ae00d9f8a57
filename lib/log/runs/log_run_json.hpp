// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "lib/log/log_run.hpp"

namespace faultline {

/// As reports of every kind hold it.
nlohmann::ordered_json log_run_json(const LogRun& run);

}  // namespace faultline
