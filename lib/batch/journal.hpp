// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <vector>

#include "lib/batch/batch_row.hpp"

namespace faultline {

/// A log that is done.
struct JournalEntry {
  std::string key;       ///< of the log's name and content, model, cases and options; empty: do it again
  int position = 0;      ///< in the list of all logs, whatever the shard
  std::string json_sha;  ///< of logs/<result>.json; empty without one
  std::string html_sha;
  BatchRow row;
};

/// What is done, one line an entry with a checksum in front. A line that a kill or a full disk cut does not
/// count; of two lines with one key the later counts. Throws Error(input) for a name of a file that is none
/// in the folder.
std::map<std::string, JournalEntry> read_journal(const std::string& path);
/// The lines in the order of the file.
std::vector<JournalEntry> read_journal_in_order(const std::string& path);
std::string to_journal_line(const JournalEntry& entry);

}  // namespace faultline
