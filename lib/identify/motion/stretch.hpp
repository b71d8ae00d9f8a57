// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <vector>

#include "lib/identify/motion/log_survey.hpp"
#include "lib/log/log_source.hpp"

namespace faultline {

/// Consecutive rows of a log without gap or missing value. Columns are rows of the log.
struct Stretch {
  int log = 0;
  double period_s = 0.0;                ///< usual sample period of the log
  bool has_dq = false;                  ///< a velocity was measured; otherwise `dq` is derived from q
  Eigen::VectorXd time;                 ///< s
  Eigen::MatrixXd q, dq, tau;           ///< joints x rows, as recorded
  Eigen::MatrixXd q_smooth, dq_smooth;  ///< smoothed q and dq, from all rows
  /// 2 joints x rows: 1 if q (upper half) or dq has no weight: outlier, stale or not measured.
  Eigen::MatrixXi outlier;
  Eigen::VectorXd noise;  ///< std of measured q, then dq, by joint

  int rows() const { return static_cast<int>(time.size()); }
  int joints() const { return static_cast<int>(q.rows()); }
};

/// Reads a log from its start and passes every `stride`-th of its stretches to `visit`, smoothed with the
/// noise of the survey of this log.
void for_each_stretch(LogSource& source, int log, int joints, const LogSurvey& survey, int stride,
                      const std::function<void(const Stretch&)>& visit);

/// A short stretch of consecutive rows, over which shooting integrates from a free start.
struct Excerpt {
  int log = 0;
  Eigen::VectorXd time;
  Eigen::MatrixXd measured;  ///< 2 joints x rows: q over dq
  Eigen::MatrixXd weight;    ///< of each measurement: 1, or 0 for outliers and for a velocity not measured
  Eigen::MatrixXd tau;       ///< joints x rows
  Eigen::MatrixXd speed;     ///< joints x rows, smoothed
  Eigen::VectorXd start;     ///< guess of (q, dq) at the first row
  double travel = 0.0;       ///< range of the smoothed velocity, summed over the joints

  int rows() const { return static_cast<int>(time.size()); }
};

/// Excerpts of all logs with a bounded number of rows: thinned evenly as they are added; in the end, those of
/// largest travel are kept.
class Excerpts {
 public:
  Excerpts(double segment_s, int min_rows, int max_rows)
      : segment_s_(segment_s), min_rows_(min_rows), max_rows_(max_rows) {}

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
