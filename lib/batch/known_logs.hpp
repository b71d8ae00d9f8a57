// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "lib/batch/appended_lines.hpp"
#include "lib/batch/file_stamp.hpp"

namespace faultline {

/// What a log contained when its files had these stamps.
struct KnownLog {
  std::string log;                 ///< BatchLog::name
  std::string sha256;              ///< of its content
  std::vector<FileStamp> files;    ///< of all files of the log
  std::vector<FileStamp> results;  ///< of its JSON and its page as the batch wrote or last checked them

  bool operator==(const KnownLog&) const = default;
};

/// The logs that earlier runs into a folder have read, so that the next run reads only those that changed.
/// The file is of use on one machine only; without it every log is read. May be used by several threads.
class KnownLogs {
 public:
  /// Reads the file, if there is one; what is damaged in it does not count. Throws Error(output) when it
  /// cannot be written.
  explicit KnownLogs(std::string path);

  /// What is known of a log of this name; stays valid. Null if nothing is.
  const KnownLog* find(const std::string& log) const;
  /// Adds what this run has read, if its files are settled (are_settled()).
  void note(KnownLog known);
  /// States that what is known of the log is still so.
  void keep(const std::string& log);
  /// Writes the file anew, with the logs that this run has noted or kept.
  void finish();

 private:
  std::string path_;
  std::map<std::string, KnownLog> before_, now_;  ///< by name
  AppendedLines lines_;
  std::mutex mutex_;
};

}  // namespace faultline
