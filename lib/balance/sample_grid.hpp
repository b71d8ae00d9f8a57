// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
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

/// What the joints say of the number of periods between rows; rows x joints.
struct RowSteps {
  Eigen::MatrixXd position;  ///< rad or m
  Eigen::MatrixXd usual;     ///< by how far a joint moves in one period, as the rows around show it
  Eigen::MatrixXd std;       ///< standard deviation of what it moves about a number of periods of `usual`
};

/// Of positions by joint, of which each has a value for each row.
RowSteps row_steps(const std::vector<std::vector<double>>& positions);

/// Whether stamps lie so far from whole periods that they alone may not say where a row stands.
bool stamps_wobble(std::span<const double> time_s, double period_s);

/// The most likely grid points of rows that were taken every `period_s` and stamped with some error: of all
/// sequences that rise, the one with the least cost of errors, lost points and rows too many (Viterbi 1967).
/// A stamp that wobbles so does not make two rows share a point. The phase of the clock is tracked, so that
/// `period_s` need not be exact. `time_s` rises or repeats. `steps` count, too, where they are given: a stamp
/// that is late by a period beside a lost row looks right, and the joints say where it belongs.
SampleGrid sample_grid(std::span<const double> time_s, double period_s, const RowSteps& steps = {});

}  // namespace faultline
