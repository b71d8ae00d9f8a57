// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "apps/work/model_paths.hpp"
#include "lib/batch/run_batch.hpp"

namespace faultline {

/// A model of a batch, and the folder whose logs it is for.
struct BatchModel {
  ModelPaths files{};
  std::string folder{};  ///< empty: for all logs that no other model is for
};

struct BatchRequest {
  std::vector<std::string> paths;
  std::vector<BatchModel> models;
  std::string folder, json, shard;
  BatchOptions options;
};

/// The part I/N of the list that `shard` asks for, such as "3/8": I from 1 to N or from 0 to N-1, so that
/// both ways of numbering tasks do. Throws Error(usage).
void take_shard(const std::string& shard, BatchOptions& options);

/// The model of an argument MODEL or DIR=MODEL; a file of that name is a model. Throws Error(usage).
BatchModel batch_model_of(const std::string& argument);

/// The logs below the paths with the model of each, after making sure that no result takes the place of an
/// input. Throws Error.
std::vector<BatchLog> claimed_logs(const BatchRequest& request);

/// Diagnoses the logs with these models, those of the request, as run_batch() does.
BatchResult run_batch_on(const std::vector<BatchLog>& logs, const std::vector<ModelFiles>& models,
                         const BatchRequest& request);

/// Puts the results of all shards into one folder, after the same care.
BatchSummary merge_shards(const std::vector<std::string>& folders, const std::string& into,
                          const std::string& json);

}  // namespace faultline
