// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace faultline {

/// Grid points of the rows of a log on a uniform grid.
struct SampleGrid {
  double start_s = 0.0;    ///< time of grid point 0, fitted to all stamps
  double period_s = 0.0;   ///< between grid points, fitted to all stamps
  std::vector<int> point;  ///< grid point of each row; -1 for a row that has none

  int points() const;  ///< number of grid points up to the last one with a row
};

/// Motion of the joints between rows, which shows the number of periods between them; rows x joints.
struct RowSteps {
  Eigen::MatrixXd position;  ///< rad or m
  Eigen::MatrixXd usual;     ///< motion of a joint in one period: median of the rows around
  Eigen::MatrixXd std;       ///< standard deviation of its motion about a multiple of `usual`
};

/// Returns the steps of positions, which are given by joint with one value for each row.
RowSteps row_steps(const std::vector<std::vector<double>>& positions);

/// Returns whether stamps lie so far from whole periods that they alone do not determine the grid points.
bool stamps_jitter(std::span<const double> time_s, double period_s);

/// Returns the most likely grid points of rows that were taken every `period_s` and stamped with some error:
/// the rising sequence with the least cost of stamp errors, lost points and surplus rows (Viterbi 1967). A
/// stamp with jitter thus does not make two rows share a point. The phase of the clock is tracked, so that
/// `period_s` need not be exact. `time_s` rises or repeats. `steps`, if given, add to the cost: a stamp that
/// is late by a period beside a lost row looks right, and the motion of the joints shows its point.
SampleGrid sample_grid(std::span<const double> time_s, double period_s, const RowSteps& steps = {});

}  // namespace faultline
