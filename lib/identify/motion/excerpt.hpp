// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "lib/identify/motion/stretch.hpp"

namespace faultline {

/// A short stretch of consecutive rows, over which shooting integrates from a free start.
struct Excerpt {
  int log = 0;
  bool has_dq = false;
  Eigen::VectorXd time;
  Eigen::MatrixXd measured;  ///< 2 joints x rows: q over dq
  Eigen::MatrixXd weight;    ///< of each measurement: 1, or 0 for outliers and for a velocity not measured
  Eigen::MatrixXd tau;       ///< joints x rows
  Eigen::MatrixXd speed;     ///< joints x rows, smoothed
  Eigen::VectorXd start;     ///< guess of (q, dq) at the first row
  double travel = 0.0;       ///< range of the smoothed velocity, summed over the joints

  int rows() const { return static_cast<int>(time.size()); }
  int joints() const { return static_cast<int>(tau.rows()); }
};

/// Excerpts of all logs with a bounded number of rows: thinned evenly as they are added; in the end, those of
/// largest travel are kept.
class Excerpts {
 public:
  Excerpts(double segment_s, int min_rows, int max_rows);

  void add(const Stretch& stretch);
  /// Returns the excerpts in the order of the logs, and leaves none.
  std::vector<Excerpt> take();

 private:
  double segment_s_;
  int min_rows_;
  std::int64_t max_rows_;
  std::int64_t seen_ = 0, stride_ = 1, held_rows_ = 0;
  std::vector<Excerpt> pool_;
};

}  // namespace faultline
