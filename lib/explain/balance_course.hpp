// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "lib/balance/uniform_log.hpp"
#include "lib/explain/explain_log.hpp"

namespace faultline {

/// How far the healthy robot, with the effects of the day, explains each row of a log, without any fault.
struct BalanceCourse {
  std::vector<double> time_s;  ///< by row, rising
  /// rows x joints: squares of the whitened residuals, of mean 1 in a healthy log; NaN for rows without
  /// weight.
  Eigen::MatrixXd square;
  double reach_s = 0.0;  ///< greatest distance of a sample from the time of a row to which it contributes
  /// rows x joints: square of the whitened effect of 1 N m or N on that joint alone.
  Eigen::MatrixXd unit_square;
};

/// Returns the course of a log for which can_explain() is true. The effects of the day are estimated from the
/// rows before the first change (first_change()). Empty at coarse rates, where no such rows are
/// distinguished.
std::optional<BalanceCourse> balance_course(const UniformLog& log, const ExplainModel& model);

}  // namespace faultline
