// SPDX-License-Identifier: MIT
#include "apps/work/batching.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <utility>

#include "apps/work/file_use.hpp"
#include "apps/work/robot_log.hpp"
#include "formats/log_formats.hpp"
#include "formats/open_log.hpp"
#include "lib/batch/find_logs.hpp"
#include "lib/batch/run_batch.hpp"
#include "lib/core/error.hpp"

namespace faultline {
namespace {

/// Adds the files that a batch writes to the folder of its results.
void writes_batch(FileUse& files, const std::string& folder) {
  for (const char* name : {"index.csv", "index.ndjson", "index.html", "summary.json", "faultline_mqc.json"})
    files.writes("-o", folder + "/" + name);
  files.writes_below("-o", folder + "/logs").writes_below("-o", folder + "/.batch");
}

std::vector<std::string> folders_of(const std::vector<BatchModel>& models) {
  std::vector<std::string> folders;
  for (const BatchModel& model : models) folders.push_back(model.folder);
  return folders;
}

void claim_files(const BatchRequest& request, const std::vector<BatchLog>& logs) {
  FileUse files;
  for (const BatchLog& log : logs) files.reads("the log", log.path);
  for (const BatchModel& model : request.models) files.reads(model.files);
  writes_batch(files, request.folder);
  files.writes("--json", request.json).writes("--junit", request.junit).claim();
}

}  // namespace

void take_shard(const std::string& text, BatchOptions& options) {
  if (text.empty()) return;
  int i = 0, n = 0;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%d/%d%c", &i, &n, &rest) != 2 || n < 1 || i < 0 || i > n)
    throw Error(ErrorCode::usage, "--shard " + text, "is not a part I/N with I from 1 to N, such as 2/8");
  options.shard = i % n;
  options.shards = n;
}

BatchModel batch_model_of(const std::string& argument) {
  const std::size_t split = argument.find('=');
  if (split == std::string::npos || std::filesystem::exists(argument)) return {{argument, ""}, ""};
  BatchModel model{{argument.substr(split + 1), ""}, argument.substr(0, split)};
  if (model.files.model.empty() || model.folder.empty())
    throw Error(ErrorCode::usage, "--model " + argument, "lacks the folder or the model; give DIR=MODEL");
  return model;
}

std::vector<BatchLog> claimed_logs(const BatchRequest& request) {
  std::vector<BatchLog> logs = find_logs(request.paths, log_name_endings());
  if (logs.empty())
    throw Error(
        ErrorCode::input, request.paths.front(),
        "contains no log; known extensions are " + fmt::format("{}", fmt::join(log_extensions(), " ")));
  for (BatchLog& log : logs) log.beside = files_beside(log.path);
  logs = with_models(std::move(logs), folders_of(request.models));
  claim_files(request, logs);
  return logs;
}

BatchResult run_batch_on(const std::vector<BatchLog>& logs, const std::vector<ModelFiles>& models,
                         const BatchRequest& request) {
  const OpenLog open = [](const std::string& path, const Robot& robot) {
    return open_robot_log(path, robot);
  };
  return run_batch(logs, open, models, request.folder, request.options);
}

BatchSummary merge_shards(const std::vector<std::string>& folders, const std::string& into,
                          const std::string& json, const std::string& junit) {
  FileUse files;
  for (const std::string& folder : folders) files.reads_below("the results of a shard", folder);
  writes_batch(files, into);
  files.writes("--json", json).writes("--junit", junit).claim();
  return merge_batches(folders, into);
}

}  // namespace faultline
