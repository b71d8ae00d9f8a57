// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lib/history/history_record.hpp"

namespace faultline {

/// Version of the tables of a history file (docs/history.md).
inline constexpr std::int64_t kHistorySchemaVersion = 1;

/// What adding records did.
struct HistoryGrowth {
  int added = 0;
  int replaced = 0;   ///< same log and model, another result
  int unchanged = 0;  ///< known before with the same result
};

// A history is one SQLite file, application id "FLHI". Both functions throw Error(input) with the defect of a
// file that is a folder or device, of another program, of another schema version or damaged: each record has
// a digest.

/// Adds the records in one transaction, completely or not at all; a record with the log and model of one that
/// is there takes its place. Makes the file if there is none; an empty file counts as none. A second writer
/// waits for the first one. Throws Error(output) if the file cannot be written.
HistoryGrowth add_to_history(const std::string& path, const std::vector<HistoryRecord>& records);

/// Returns all records in the order in which they were added first; changes nothing.
std::vector<HistoryRecord> read_history(const std::string& path);

}  // namespace faultline
