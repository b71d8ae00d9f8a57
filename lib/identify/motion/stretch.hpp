// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <functional>

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

}  // namespace faultline
