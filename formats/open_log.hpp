// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "lib/log/channels.hpp"
#include "lib/log/log_source.hpp"
#include "lib/log/raw_reader.hpp"

namespace faultline {

struct OpenLogOptions {
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
std::unique_ptr<RawReader> open_raw(const std::string& path);

}  // namespace faultline
