// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lib/reproduce/reproduce.hpp"

namespace faultline {

struct ReproducedFolder {
  Reproduction reproduction;
  std::string json;  ///< as in index.json
};

/// Rebuilds the paper's tables and figures into the folder: index.md, index.json and the pictures.
ReproducedFolder reproduce_into(const std::string& folder, const ReproduceOptions& options,
                                const Progress& progress);

}  // namespace faultline
