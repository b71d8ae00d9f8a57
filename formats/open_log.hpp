// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "formats/parts/joined_reader.hpp"
#include "lib/log/channels.hpp"
#include "lib/log/log_source.hpp"
#include "lib/log/raw_reader.hpp"

namespace faultline {

/// Selects the files that form a log, and one of its runs.
struct LogSelection {
  std::vector<std::string> then{};  ///< files that continue it
  std::vector<std::string> join{};  ///< files with more columns of it
  JoinBy by = JoinBy::automatic;    ///< how their rows are matched
  int run = kEveryRun;              ///< number from 1; a run ends when the clock restarts
  bool hashed = true;               ///< identity() has the SHA-256; without it text is read in half the time
};

struct OpenLogOptions {
  LogSelection parts{};
  ColumnMap columns{};          ///< [log.columns] of the robot file: robot.log.columns
  RecordingChoice recording{};  ///< [log] of the robot file: robot.log.recording
  std::vector<bool> slides{};   ///< by joint: it slides and so has no turns; empty if unknown
  int segment_rows = 4096;      ///< upper limit of the rows of a segment; changes no byte of any result
  bool keep_extra =
      true;  ///< also return columns without a canonical meaning; reading is faster without them
};

/// Opens a log of any known format, recognised by its content first, then by its extension. Throws
/// Error(input) when the file is missing, a directory, empty, of no known format, or has no time or position.
std::unique_ptr<LogSource> open_log(const std::string& path, const OpenLogOptions& options = {});

/// Opens the columns of a file before any channel mapping; also for files that are no joint log. `choice`
/// says which messages of a recording are the log.
std::unique_ptr<RawReader> open_raw(const std::string& path, bool hashed = true,
                                    const RecordingChoice& choice = {});

/// Does the same for a log of several files: `choice` applies to each of them.
std::unique_ptr<RawReader> open_parts(const std::string& path, const LogSelection& parts,
                                      const RecordingChoice& choice);

/// Returns the other files that belong to the log at `path`, such as the data files of a DIAdem header; empty
/// for a log of one file, and for what cannot be read.
std::vector<std::string> files_beside(const std::string& path);

}  // namespace faultline
