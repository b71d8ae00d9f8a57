// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "lib/core/progress.hpp"
#include "lib/reproduce/page/reproduction.hpp"

namespace faultline {

struct SimulateRequest {
  std::string spec;
  std::string folder;
  std::optional<std::uint64_t> seed;
};

/// Writes the logs of a spec file and their labels.csv; returns a summary, schema "faultline/simulation/1".
nlohmann::ordered_json simulate_into(const SimulateRequest& request, const Progress& progress);

struct ReproducedFolder {
  Reproduction reproduction;
  std::string json;  ///< as in index.json
};

/// Rebuilds the paper's tables and figures into the folder: index.md, index.json and the pictures.
ReproducedFolder reproduce_into(const std::string& folder, const ReproduceOptions& options,
                                const Progress& progress);

}  // namespace faultline
