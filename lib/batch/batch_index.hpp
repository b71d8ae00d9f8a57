// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <map>
#include <vector>

#include "lib/batch/batch_folder.hpp"
#include "lib/batch/batch_summary.hpp"
#include "lib/batch/growing_file.hpp"
#include "lib/batch/journal.hpp"

namespace faultline {

/// index.ndjson and index.csv, which grow in the order of the list whatever the order of the results, and
/// what is written when all are there. One thread at a time.
class BatchIndex {
 public:
  /// `results` are expected.
  BatchIndex(const BatchFolder& folder, int results);

  /// Takes result `place` (0 to results-1), each once.
  void put(int place, JournalEntry entry);
  /// Writes summary.json, index.html and the final journal, and removes what is no result of this batch.
  BatchSummary finish(const BatchFacts& facts);

 private:
  const BatchFolder& folder_;
  GrowingFile ndjson_, csv_;
  std::vector<JournalEntry> entries_;
  std::vector<bool> there_;
  std::size_t next_ = 0;  ///< not yet in the files
};

}  // namespace faultline
