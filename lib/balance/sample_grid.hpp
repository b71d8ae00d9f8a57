// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

namespace faultline {

/// Where the rows of a log stand on a uniform grid.
struct SampleGrid {
  double start_s = 0.0;    ///< time of grid point 0, as all stamps show it
  double period_s = 0.0;   ///< between grid points, as all stamps show it
  std::vector<int> point;  ///< grid point of each row; -1 for a row that has none

  int points() const;  ///< up to the last one that a row stands at
};

/// The most likely grid points of rows that were taken every `period_s` and stamped with some error: of all
/// sequences that rise, the one with the least cost of errors, lost points and rows too many (Viterbi 1967).
/// A stamp that wobbles so does not make two rows share a point. The phase of the clock is tracked, so that
/// `period_s` need not be exact. `time_s` rises or repeats.
SampleGrid sample_grid(std::span<const double> time_s, double period_s);

}  // namespace faultline
