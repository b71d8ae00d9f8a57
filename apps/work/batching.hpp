// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "apps/work/file_use.hpp"
#include "lib/batch/run_batch.hpp"

namespace faultline {

/// A model of a batch, and the folder with the logs for it.
struct BatchModel {
  ModelPaths files{};
  std::string folder{};  ///< empty: for all logs without another model
};

struct BatchRequest {
  std::vector<std::string> paths;
  std::vector<BatchModel> models;
  std::string folder, json, junit, shard;
  BatchOptions options;
};

/// Sets the part I/N of the list from `shard`, such as "3/8"; I may be 1 to N or 0 to N-1, for both ways of
/// numbering tasks. Throws Error(usage).
void take_shard(const std::string& shard, BatchOptions& options);

/// Parses the argument MODEL or DIR=MODEL; if a file has that name, it is a model. Throws Error(usage).
BatchModel batch_model_of(const std::string& argument);

/// Returns the logs below the paths with the model of each, after checking that no result replaces an input.
/// Throws Error.
std::vector<BatchLog> claimed_logs(const BatchRequest& request);

/// Diagnoses the logs with these models, those of the request, as run_batch() does.
BatchResult run_batch_on(const std::vector<BatchLog>& logs, const std::vector<ModelFiles>& models,
                         const BatchRequest& request);

/// Puts the results of all shards into one folder, after the same check.
BatchSummary merge_shards(const std::vector<std::string>& folders, const std::string& into,
                          const std::string& json, const std::string& junit = "");

}  // namespace faultline
