// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "lib/identify/stretch.hpp"

namespace faultline {

/// A short run of consecutive rows that shooting integrates over from a free start.
struct Excerpt {
  int log = 0;
  bool has_dq = false;
  Eigen::VectorXd time;
  Eigen::MatrixXd measured;  ///< 2 joints x rows: q over dq
  Eigen::MatrixXd weight;    ///< of each measurement, 0 to 1; 0 for outliers and for a velocity not measured
  Eigen::MatrixXd tau;       ///< joints x rows
  Eigen::VectorXd start;     ///< guess of (q, dq) at the first row
  double travel = 0.0;       ///< how much the joints move in it against the usual noise

  int rows() const { return static_cast<int>(time.size()); }
  int joints() const { return static_cast<int>(tau.rows()); }
};

/// Excerpts of all logs with a bounded number of rows: thinned evenly while they come, at the end those that
/// move most stay.
class Excerpts {
 public:
  Excerpts(double segment_s, int min_rows, int max_rows);

  void add(const Stretch& stretch);
  /// In the order of the logs.
  std::vector<Excerpt> take();

 private:
  double segment_s_;
  int min_rows_;
  std::int64_t max_rows_;
  std::int64_t seen_ = 0, stride_ = 1, held_rows_ = 0;
  std::vector<Excerpt> pool_;
};

/// Measurement noise seen as roughness: what a local quadratic over some 10 ms leaves, by channel.
class Roughness {
 public:
  void add(const Stretch& stretch);
  /// Std of q (first) and dq by joint; NaN where no log was fast enough to tell.
  Eigen::VectorXd std() const;
  /// Largest minus smallest value of q (first) and dq by joint.
  Eigen::VectorXd range() const { return high_ - low_; }
  bool has_dq() const { return has_dq_; }
  /// Whether a joint's position only jitters: neighbours differ as much as any two samples (von Neumann
  /// 1941), or its range is below `least`.
  bool still(int joint, double least) const;

 private:
  void add_steps(const Stretch& stretch);

  bool has_dq_ = false;
  Eigen::VectorXd sum_, count_, low_, high_;
  Eigen::VectorXd first_, samples_, mean_, square_, steps_,
      step_square_;  ///< of q by joint, from its first value
};

}  // namespace faultline
