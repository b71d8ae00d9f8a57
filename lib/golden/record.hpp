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

/// A model that is to become the folder's.
struct NewModel {
  std::string model;  ///< path of its file
  const ModelAndCases* subject = nullptr;
};

/// Makes what `run` says of the named logs (and of "identification" and "model") what is expected of them,
/// and takes the new model when there is one. A named log whose files were changed is taken as it is now. All
/// appears with the new golden.toml, or nothing does. Throws Error(input), with nothing changed, for a log
/// that cannot be processed.
/// `defaults` hold for channels that the folder gives no tolerance.
void accept_golden(const std::string& folder, GoldenSet set, const GoldenRun& run,
                   const std::vector<std::string>& names, const NewModel& new_model = {},
                   const Tolerances& defaults = {});

}  // namespace faultline
