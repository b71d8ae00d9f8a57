// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "lib/batch/batch_summary.hpp"
#include "lib/batch/find_logs.hpp"
#include "lib/diagnose/diagnose.hpp"
#include "lib/model/model_files.hpp"

namespace faultline {

struct BatchProgress {
  int done = 0, diagnosed = 0, logs = 0;
};

struct BatchOptions {
  DiagnoseOptions diagnose;
  bool html = false;      ///< a page a log, besides its JSON
  bool identify = false;  ///< the robot's parameters from each healthy log alone, for trends
  int threads = 0;        ///< logs at once; 0 = one a core
  int shard = 0;          ///< take the logs whose position in the list is this one modulo `shards`
  int shards = 1;
  std::string twins;                                     ///< pairs of joints to compare (BatchFacts::twins)
  bool wait = false;                                     ///< for another batch into the same folder
  std::function<void(const BatchProgress&)> progress{};  ///< never called by two threads at once
};

struct BatchResult {
  BatchSummary summary;
  int diagnosed = 0;  ///< by this run; the others were done before
};

using OpenLog = std::function<std::unique_ptr<LogSource>(const std::string& path, const Robot& robot)>;

/// Diagnoses every log with its model of `models` (BatchLog::model) into `folder` (docs/batch.md). What an
/// earlier run, finished or killed, has done with the same log, model, cases and options is kept. A log that
/// cannot be used is a row with its reason. The same input gives the same bytes, whatever the threads and
/// however often it was cut short. Throws Error(output) when results cannot be written.
BatchResult run_batch(const std::vector<BatchLog>& logs, const OpenLog& open,
                      const std::vector<ModelFiles>& models, const std::string& folder,
                      const BatchOptions& options = {});

/// Puts the finished shards of one batch together into `into`: the same bytes as one run over the whole list.
/// Throws Error(input) when a folder is no finished batch, was made with other model, cases, options or logs,
/// or a shard is missing.
BatchSummary merge_batches(const std::vector<std::string>& folders, const std::string& into);

}  // namespace faultline
