// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>

#include "lib/log/log_source.hpp"

namespace faultline {

/// How rows that repeat the one before in every channel came into a log whose robot moves.
enum class RepeatedRows {
  none,
  stale,  ///< nothing new was received: the time is right, the values are old
  extra,  ///< one reading was written twice and the time counted on: rows and time are to be taken out
};

/// Consecutive rows of a log without gap or missing value, as recorded. Columns are rows of the log.
struct RawStretch {
  Eigen::VectorXd time;
  Eigen::MatrixXd q, dq, tau;  ///< joints x rows; dq is empty when it was not recorded
  Eigen::VectorXi stale;  ///< 1: the row repeats the one before; its torque is put between its neighbours

  int rows() const { return static_cast<int>(time.size()); }
  int joints() const { return static_cast<int>(q.rows()); }
};

struct StretchSummary {
  std::int64_t rows = 0;  ///< that hold a position or torque
  double period_s = 0.0;  ///< usual sample period
};

/// Reads a log from its start and hands out its stretches of at most kStretchRows rows, whose borders do not
/// depend on the source's segments. Throws Error(input) when the log lacks torque or has other joints.
inline constexpr int kStretchRows = 2500;
StretchSummary for_each_raw_stretch(LogSource& source, int joints, RepeatedRows repeated,
                                    const std::function<void(const RawStretch&)>& visit);

}  // namespace faultline
