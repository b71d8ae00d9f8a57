// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/diagnose/diagnosis.hpp"

namespace faultline {

/// What a whole batch was made with. Folders with the same facts, but for the shard, can be merged.
struct BatchFacts {
  std::vector<ModelFacts> models;  ///< those that logs of the list have, in the order of the list
  std::string program_version;
  std::string options;  ///< such as "--classify evidence --html"
  int logs = 0;         ///< in the list, before sharding
  int shard = 0;        ///< takes the logs whose position is this one modulo `shards`
  int shards = 1;

  bool operator==(const BatchFacts& other) const;
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

}  // namespace faultline
