// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "lib/core/issue.hpp"
#include "lib/log/log.hpp"

namespace faultline {

/// A magnitude that no joint signal or time in SI reaches; beyond it a number is damage, not measurement.
inline constexpr double kImplausible = 1e12;

/// What cleaning carries from one segment to the next.
struct CleanState {
  double last_time = -1e300;  ///< of the last row kept; below any time before the first
  double last_step = 0.0;     ///< between the last two rows kept; 0 before the second
  double first_time = 0.0;    ///< of the present run, once it has a row
  int wanted_run = 1;         ///< rows of other runs are removed
  int run = 1;                ///< the present one; the clock's restart begins another
};

/// Removes the rows whose time is missing, implausible, repeated or not after the row before, and a single
/// row whose time leaps ahead of the row after it. Where the clock restarts, that is goes back by more than
/// half of the run and on from there, another run begins, and rows of runs that are not wanted are removed.
/// Values that are infinite or implausible become NaN. Every removal and change is in `issues`. Row i of the
/// segment is data row first_row + i + 1 of the file.
///
/// Unless `at_end`, a last row that leaps ahead or far back cannot be judged yet: it is taken off the segment
/// and returned (as a log of one row) to be put in front of the next one; otherwise the returned log has no
/// rows.
Log clean(Log& segment, std::int64_t first_row, bool at_end, CleanState& state, Issues& issues);

}  // namespace faultline
