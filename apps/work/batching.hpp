// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "apps/work/model_paths.hpp"
#include "lib/batch/run_batch.hpp"

namespace faultline {

struct BatchRequest : ModelPaths {
  std::vector<std::string> paths;
  std::string folder, json, shard;
  BatchOptions options;
};

/// The part I/N of the list that `shard` asks for, such as "3/8": I from 1 to N or from 0 to N-1, so that
/// both ways of numbering tasks do. Throws Error(usage).
void take_shard(const std::string& shard, BatchOptions& options);

/// The logs below the paths, after making sure that no result takes the place of an input. Throws Error.
std::vector<BatchLog> claimed_logs(const BatchRequest& request);

/// Diagnoses the logs with this model as run_batch() does.
BatchResult run_batch_on(const std::vector<BatchLog>& logs, const Model& model, const CaseBase& cases,
                         const BatchRequest& request);

/// Puts the results of all shards into one folder, after the same care.
BatchSummary merge_shards(const std::vector<std::string>& folders, const std::string& into,
                          const std::string& json);

}  // namespace faultline
