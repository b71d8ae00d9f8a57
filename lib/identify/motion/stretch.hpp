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
  bool has_dq = false;                  ///< a velocity was measured; else `dq` comes from q
  Eigen::VectorXd time;                 ///< s
  Eigen::MatrixXd q, dq, tau;           ///< joints x rows, as recorded
  Eigen::MatrixXd q_smooth, dq_smooth;  ///< what q and dq were, given all rows
  /// 2 joints x rows: 1 where q (upper half) or dq says nothing: off its neighbours, stale, or not measured.
  Eigen::MatrixXi outlier;
  Eigen::VectorXd noise;  ///< std of measured q, then dq, by joint

  int rows() const { return static_cast<int>(time.size()); }
  int joints() const { return static_cast<int>(q.rows()); }
};

/// Reads a log from its start and hands out every `stride`-th of its stretches, smoothed as the survey of
/// this log says.
void for_each_stretch(LogSource& source, int log, int joints, const LogSurvey& survey, int stride,
                      const std::function<void(const Stretch&)>& visit);

}  // namespace faultline
