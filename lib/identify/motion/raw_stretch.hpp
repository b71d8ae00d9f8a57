// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>

#include "lib/identify/motion/motion_smoother.hpp"
#include "lib/log/log_source.hpp"

namespace faultline {

/// Cause of rows that repeat the row before in every channel while the robot moves.
enum class RepeatedRows {
  none,
  stale,  ///< no new sample was received: the time is right, the values are old
  extra,  ///< one sample was written twice and the time counted on: rows and time are to be removed
};

/// Consecutive rows of a log without gap or missing value, as recorded. Columns are rows of the log.
struct RawStretch {
  Eigen::VectorXd time;
  Eigen::MatrixXd q, dq, tau;  ///< joints x rows; dq is empty if it was not recorded
  Eigen::VectorXi stale;       ///< 1: the row repeats the one before; its torque is interpolated

  int rows() const { return static_cast<int>(time.size()); }
  int joints() const { return static_cast<int>(q.rows()); }
};

struct StretchSummary {
  std::int64_t rows = 0;  ///< rows that hold a position or torque
  double period_s = 0.0;  ///< usual sample period
};

inline constexpr int kStretchRows = 2500;  ///< largest number of rows in a stretch
/// Reads a log from its start and passes on its stretches of at most kStretchRows rows, independent of the
/// source's segments. Throws Error(input) if the log lacks torque or its joints differ in number.
StretchSummary for_each_raw_stretch(LogSource& source, int joints, RepeatedRows repeated,
                                    const std::function<void(const RawStretch&)>& visit);

/// Returns the samples of one joint, with outliers and stale rows marked in `q_off` and `dq_off`.
JointMotion joint_motion(const RawStretch& stretch, int j);

}  // namespace faultline
