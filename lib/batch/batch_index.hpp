// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "lib/batch/batch_folder.hpp"
#include "lib/batch/batch_summary.hpp"
#include "lib/batch/journal.hpp"

namespace faultline {

/// A file that grows line by line for readers who follow it. What it already holds from an earlier run and
/// what comes again stays untouched; from the first difference on it is written anew. A file that has other
/// names, too (hard links), keeps those and its content: under this one a new file takes its place.
class GrowingFile {
 public:
  /// Throws Error(output).
  explicit GrowingFile(std::string path);
  ~GrowingFile();
  GrowingFile(const GrowingFile&) = delete;
  GrowingFile& operator=(const GrowingFile&) = delete;

  void append(std::string_view text);
  /// Cuts what an earlier run had beyond the end.
  void finish();

 private:
  void begin_anew();
  bool is_there_already(std::string_view text) const;
  [[noreturn]] void fail() const;

  std::string path_;
  int file_ = -1;
  long long size_ = 0;
  bool anew_ = false;
};

/// index.ndjson and index.csv, which grow in the order of the list whatever the order of the results, and
/// what is written when all are there. One thread at a time.
class BatchIndex {
 public:
  /// `results` are expected.
  BatchIndex(const BatchFolder& folder, int results);

  /// Takes result `place` (0 to results-1), each once.
  void put(int place, JournalEntry entry);
  /// Writes summary.json, index.html and the final journal, and removes what is no result of this batch. To
  /// be called once, when all results are there.
  BatchSummary finish(const BatchFacts& facts);

 private:
  const BatchFolder& folder_;
  GrowingFile ndjson_, csv_;
  std::vector<JournalEntry> entries_;
  std::vector<bool> there_;
  std::size_t next_ = 0;  ///< not yet in the files
};

}  // namespace faultline
