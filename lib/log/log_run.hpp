// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace faultline {

/// A stretch of a log between two restarts of its clock. Where several runs are read as one log, the later
/// ones follow the earlier ones with a gap between: their times are those of their own clock plus an offset.
struct LogRun {
  int run = 1;                 ///< from 1
  std::int64_t first_row = 0;  ///< of the file's data rows, from 1
  std::int64_t rows = 0;       ///< those with a usable time
  double start_s = 0.0;        ///< first and last time, as the log is handed out
  double end_s = 0.0;
  double clock_offset_s = 0.0;  ///< time in the log less the time of the run's own clock
  bool is_read = true;          ///< false: another run was asked for
};

/// Runs to read: every one, as one log.
inline constexpr int kEveryRun = 0;

}  // namespace faultline
