// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>

namespace faultline {

/// A part of a log between two restarts of its clock. If several runs are read as one log, each follows the
/// one before after a gap: its times are those of its own clock plus an offset.
struct LogRun {
  int run = 1;                 ///< number of the run, from 1
  std::int64_t first_row = 0;  ///< first data row of the file, from 1
  std::int64_t rows = 0;       ///< rows with a usable time
  double start_s = 0.0;        ///< first and last time, as in the segments
  double end_s = 0.0;
  double clock_offset_s = 0.0;  ///< time in the log minus time of the run's own clock
  bool is_read = true;          ///< false if another run was requested
};

/// Value of a run option: all runs are read as one log.
inline constexpr int kEveryRun = 0;

/// Returns the run as a JSON object, the same in reports of every kind.
nlohmann::ordered_json log_run_json(const LogRun& run);

}  // namespace faultline
