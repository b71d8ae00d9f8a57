// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <set>
#include <string>

#include "lib/batch/batch_folder.hpp"
#include "lib/batch/find_logs.hpp"
#include "lib/batch/journal.hpp"

namespace faultline {

/// What earlier runs into a folder have done, finished or killed.
class EarlierResults {
 public:
  explicit EarlierResults(const BatchFolder& folder);

  /// `settings`: settings_of() this run and the log's model. The entry of the log as it is now, when its
  /// result files are there as they were written; null else. The log is read, for its hash, only when one of
  /// its name was done. Throws Error(input) when it cannot be.
  const JournalEntry* find(const BatchLog& log, const std::string& settings) const;

 private:
  const BatchFolder& folder_;
  std::map<std::string, JournalEntry> entries_;  ///< by key
  std::set<std::string> logs_;                   ///< names
};

}  // namespace faultline
