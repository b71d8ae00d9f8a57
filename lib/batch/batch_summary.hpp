// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <vector>

#include "lib/batch/batch_row.hpp"
#include "lib/core/joint.hpp"
#include "lib/diagnose/diagnosis.hpp"
#include "lib/wear/robot_wear.hpp"
#include "lib/wear/twins.hpp"

namespace faultline {

/// What a whole batch was made with. Folders with the same facts, but for the shard, can be merged.
struct BatchFacts {
  std::vector<ModelFacts> models;  ///< those that logs of the list have, in the order of the list
  std::string program_version;
  std::string options;  ///< such as "--classify evidence --html"
  int logs = 0;         ///< in the list, before sharding
  int shard = 0;        ///< takes the logs whose position is this one modulo `shards`
  int shards = 1;
  std::string twins;  ///< pairs of joints to compare, such as "1:4,2:5"; decides no result of a log
};

/// Of all that decides a result besides the log; of facts that differ in nothing else but logs and shards it
/// is the same.
std::string settings_of(const BatchFacts& facts);
/// The same of what decides the results of the logs of one model.
std::string settings_of(const BatchFacts& facts, const ModelFacts& model);

/// Schema "faultline/batch/2".
std::string facts_to_json(const BatchFacts& facts);
/// Throws Error(input).
BatchFacts read_facts(const std::string& path);

struct BatchCounts {
  int logs = 0, healthy = 0, faulty = 0, inconclusive = 0, unusable = 0, failed = 0;
  int faults = 0;
  double hours = 0.0;             ///< of the logs that were judged
  double median_residual = 0.0;   ///< of residual_level(); NaN without any
  double largest_residual = 0.0;  ///< likewise
};

struct LogWithoutDiagnosis {
  std::string log;
  std::string reason;
};

struct BatchSummary {
  BatchFacts facts;
  BatchCounts all;
  std::map<std::string, BatchCounts> models;          ///< by BatchRow::model_sha256
  std::map<std::string, BatchCounts> folders;         ///< by folder_of()
  std::map<std::string, std::map<Joint, int>> kinds;  ///< faults by kind and joint
  std::vector<RobotWear> wear;                        ///< by model, those of the facts with logs
  TwinReport robots;                                  ///< the models compared, if there are several
  TwinReport joints;                                  ///< pairs of joints, if facts.twins names some
  std::vector<LogWithoutDiagnosis> not_diagnosed;     ///< unusable or failed, in the order of the rows
  int status = 0;                                     ///< exit status: the worst of all logs
};
BatchSummary summary_of(const std::vector<BatchRow>& rows, const BatchFacts& facts);

/// Schema "faultline/batch-summary/2"; no wall-clock time is in it.
std::string to_json(const BatchSummary& summary);
/// A few lines for a terminal.
std::string to_text(const BatchSummary& summary);

}  // namespace faultline
