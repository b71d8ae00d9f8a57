// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "formats/log_writer.hpp"
#include "lib/core/issue.hpp"
#include "lib/core/progress.hpp"
#include "lib/log/log_source.hpp"

namespace faultline {

/// What became of a log that was written in another format.
struct Conversion {
  std::int64_t rows_read = 0, rows_written = 0;
  Issues issues;             ///< of reading the log
  bool lost_values = false;  ///< rows, values or signals were lost; the written log records this, too
};

/// Writes a log to the file `out`, whose extension determines the format, with the events of its diagnosis if
/// they are given. The file is there whole or not at all. Throws Error(usage) for an unknown extension and
/// for events that the format cannot hold, Error(output) if the file cannot be written.
Conversion convert_log(LogSource& log, const std::string& out,
                       const std::optional<std::vector<LogEvent>>& events, const Progress& progress);

}  // namespace faultline
