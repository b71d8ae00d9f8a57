// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "lib/core/progress.hpp"
#include "lib/golden/observation.hpp"
#include "lib/log/log_source.hpp"
#include "lib/model/model_files.hpp"

namespace faultline {

/// Opens a log file as the model's robot file says; given by the program, as the library knows no format.
using LogOpener = std::function<std::unique_ptr<LogSource>(const std::string& path, const Model& model)>;

struct ModelAndCases : ModelFiles {
  std::string name;  ///< file name of the model
};

struct ReplayLog {
  std::string name;
  std::string path;
  bool identify = false;  ///< is one of the logs that the robot is identified from
};

struct ReplayOptions {
  int trace_points = 500;
  int threads = 0;  ///< 0 = one a core; changes no byte of the result
};

/// Diagnoses all logs and identifies the model's robot from those marked for it (nothing when none is). A log
/// that cannot be processed is an Observation of verdict "unusable", with the reason.
GoldenRun replay(const std::vector<ReplayLog>& logs, const ModelAndCases& subject, const LogOpener& open,
                 const ReplayOptions& options = {}, const Progress& progress = {});

/// Identification of `model.robot` from these logs; "unusable" when they do not suffice.
ObservedIdentification observe_identification(const std::vector<ReplayLog>& logs, const Model& model,
                                              const LogOpener& open, int threads);

}  // namespace faultline
