// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <functional>

#include "lib/core/issue.hpp"
#include "lib/log/log_source.hpp"

namespace faultline {

/// Consecutive rows of a log without gap or missing value. Columns are rows of the log.
struct Stretch {
  int log = 0;
  double period_s = 0.0;  ///< usual sample period of the log
  bool has_dq = false;    ///< else `dq` was derived from q
  Eigen::VectorXd time;
  Eigen::MatrixXd q, dq, tau;           ///< joints x rows, as recorded
  Eigen::MatrixXd q_smooth, dq_smooth;  ///< local quadratic over some 10 ms; as recorded on slow logs
  Eigen::MatrixXi outlier;  ///< 2 joints x rows: 1 where q (upper half) or dq stands off its neighbours

  int rows() const { return static_cast<int>(time.size()); }
  int joints() const { return static_cast<int>(q.rows()); }
};

struct StretchSummary {
  std::int64_t rows = 0;
  double period_s = 0.0;
};

/// Reads a log from its start and hands out its stretches of at most kStretchRows rows, whose borders do not
/// depend on the source's segments. Throws Error(input) when the log lacks torque or has other joints.
inline constexpr int kStretchRows = 2500;
StretchSummary for_each_stretch(LogSource& source, int log, int joints,
                                const std::function<void(const Stretch&)>& visit);

}  // namespace faultline
