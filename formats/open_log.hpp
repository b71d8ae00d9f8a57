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

/// Of which files a log is made, and which of their runs it is.
struct LogSelection {
  std::vector<std::string> then{};  ///< files in which it goes on
  std::vector<std::string> join{};  ///< files with more columns of it
  JoinBy by = JoinBy::automatic;    ///< how their rows are found
  int run = kEveryRun;              ///< where the clock restarts, from 1
  bool hashed = true;               ///< identity() has the SHA-256; text is read in half the time without
};

struct OpenLogOptions {
  LogSelection parts{};
  ColumnMap columns{};          ///< [log.columns] of the robot file: robot.log.columns
  RecordingChoice recording{};  ///< [log] of the robot file: robot.log.recording
  int segment_rows = 4096;      ///< rows of a segment at most; changes no byte of any result
  bool keep_extra =
      true;  ///< hand out columns without a canonical meaning too; without them reading is faster
};

/// Opens a log of any known format, told by its content first, then by its extension. Throws Error(input)
/// when the file is missing, a directory, empty, of no known format, or has no time or position.
std::unique_ptr<LogSource> open_log(const std::string& path, const OpenLogOptions& options = {});

/// The file's columns before any channel mapping; for looking into files that are no joint log.
std::unique_ptr<RawReader> open_raw(const std::string& path, bool hashed = true);

/// The same of a log of several files: `choice` holds for each of them.
std::unique_ptr<RawReader> open_parts(const std::string& path, const LogSelection& parts,
                                      const RecordingChoice& choice);

}  // namespace faultline
