// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <set>
#include <string>

#include "lib/batch/batch_folder.hpp"
#include "lib/batch/file_stamp.hpp"
#include "lib/batch/find_logs.hpp"
#include "lib/batch/journal.hpp"
#include "lib/batch/known_logs.hpp"
#include "lib/batch/run_batch.hpp"

namespace faultline {

/// The name in logs/ of the result of a log of this name and content: readable, without what a file name
/// should not hold, and different for different names or contents.
std::string result_name(const std::string& log_name, const std::string& log_sha256);

/// Of a log's name and content and of the settings (settings_of).
std::string result_key(const std::string& settings, const BatchLog& log, const std::string& log_sha256);

/// What all logs of a batch are diagnosed with, and where the results go.
struct BatchSetup {
  const OpenLog& open;
  const std::vector<ModelFiles>& models;
  const BatchFolder& folder;
  const BatchOptions& options;
  std::vector<ModelFacts> facts;      ///< of each of the models
  std::vector<std::string> settings;  ///< settings_of() the batch and each of the models
};

/// Diagnoses one log and writes its result files; the entry has no position yet.
/// Throws Error(input) when the log cannot be used and Error(output) when a file cannot be written.
JournalEntry write_log_result(const BatchLog& log, const BatchSetup& setup);

/// Of a log of `model` that could not be used for this reason, without position. It has no key, so that the
/// next run does it again, when the file is another one than `before` it was read, cannot be read, or the
/// reason is a defect of the program.
JournalEntry unusable_result(const BatchLog& log, const FileStamp& before, const Error& reason,
                             const ModelFacts& model, const std::string& settings);

/// What earlier runs into a folder have done, finished or killed.
class EarlierResults {
 public:
  explicit EarlierResults(const BatchFolder& folder);

  /// `stamps`: of the log's files now; `settings`: settings_of() this run and the log's model. The entry of
  /// the log as it is now, when its result files are there as they were written; null else. The log is read,
  /// for its hash, only when one of its name was done and its files are not those that `known` describes; so
  /// are its result files. Throws Error(input) when it cannot be.
  const JournalEntry* find(const BatchLog& log, const std::vector<FileStamp>& stamps,
                           const std::string& settings, KnownLogs& known) const;

 private:
  const BatchFolder& folder_;
  std::map<std::string, JournalEntry> entries_;  ///< by key
  std::set<std::string> logs_;                   ///< names
};

/// Notes that the files of the log, with these stamps, have the content of this entry, and that its results
/// are as they are now.
void note_result(const BatchLog& log, const std::vector<FileStamp>& stamps, const JournalEntry& entry,
                 const BatchFolder& folder, KnownLogs& known);

/// Paths of all files of the log.
std::vector<std::string> files_of(const BatchLog& log);

}  // namespace faultline
