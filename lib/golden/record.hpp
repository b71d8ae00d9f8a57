// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/golden/golden_folder.hpp"

namespace faultline {

struct RecordOptions {
  bool identify = true;    ///< from the logs that are found healthy
  int trace_points = 500;  ///< of a log at most
  int threads = 0;
};

struct Recorded {
  GoldenSet set;
  std::string no_identification;  ///< why nothing was identified; empty when something was
};

/// Makes a golden folder of these logs: copies the logs (those that are not below it already), the model and
/// the case base into it, and writes down what faultline says now. golden.toml comes last, so that an
/// interrupted recording leaves no golden folder. Throws Error(usage) when the folder is one already or names
/// clash, Error(input) when a log cannot be processed.
Recorded record_golden(const std::string& folder, const std::vector<std::string>& logs,
                       const std::string& model, const std::string& cases, const LogOpener& open,
                       const RecordOptions& options = {}, const Progress& progress = {});

}  // namespace faultline
