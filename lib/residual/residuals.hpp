// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "lib/log/log.hpp"
#include "lib/residual/residual_generator.hpp"
#include "lib/residual/transitions.hpp"

namespace faultline {

/// Measured minus predicted, one column a prediction; joints x predictions. A prediction belongs to its later
/// row.
struct Residuals {
  std::vector<std::int64_t> row;  ///< counted from the first row of the log
  Eigen::VectorXd time;           ///< s
  Eigen::MatrixXd position;       ///< in units of the healthy rms, so that about 1 is healthy
  Eigen::MatrixXd velocity;       ///< likewise
  Eigen::MatrixXd torque;  ///< M(q) r / dt with r the velocity residual in rad/s or m/s: N m or N. A joint
                           ///< that swings freely shows minus its torque on its own axis (docs/residual.md)
  Eigen::MatrixXd tau;     ///< mean torque over the step as logged, N m or N
  Eigen::MatrixXd ratio;   ///< torque * tau / (tau^2 + eps^2): -1 for a free joint, 0 for a healthy one;
                           ///< eps is three times the healthy rms of `torque`

  int joints() const { return static_cast<int>(velocity.rows()); }
  int count() const { return static_cast<int>(row.size()); }
};

/// Residuals::ratio of torque-space residuals and torques, joints x samples; `torque_rms` is that of healthy
/// residuals.
Eigen::MatrixXd ratio_to_torque(const Eigen::MatrixXd& torque, const Eigen::MatrixXd& tau,
                                const Eigen::VectorXd& torque_rms);

using ResidualState = TransitionState;

/// Computes the residuals of all predictions that end in `segment`. Segments of one log are passed in order
/// with the same state; the result does not depend on their borders. Rows with missing numbers, and pairs
/// across a gap, give NaN. The velocities of a log without any are derived from its positions; a log without
/// torque has no residuals. Throws Error(input) when the log has other joints.
Residuals compute_residuals(const ResidualGenerator& generator, const Log& segment, ResidualState& state);
/// Returns the transitions that compute_residuals() uses, for a log that has torque.
Transitions log_transitions(const ResidualGenerator& generator, const Log& segment, ResidualState& state);
Residuals residuals_of(const ResidualGenerator& generator, const Transitions& transitions);

}  // namespace faultline
