// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "lib/core/progress.hpp"

namespace faultline {

struct SimulateRequest {
  std::string spec;
  std::string folder;
  std::optional<std::uint64_t> seed;
};

/// Writes the logs of a spec file and their labels.csv; returns a summary, schema "faultline/simulation/1".
nlohmann::ordered_json simulate_into(const SimulateRequest& request, const Progress& progress);

}  // namespace faultline
