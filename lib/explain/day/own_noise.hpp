// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "lib/balance/noise.hpp"
#include "lib/explain/log_fit.hpp"

namespace faultline {

/// Rows of a log that are explained without a fault, from the first one on.
struct CalmRows {
  Eigen::MatrixXd torque;  ///< rows x joints: residual beside the effects of the day; 0 if it does not count
  JointMask counts;        ///< rows x joints: not lost, not silent, not near a change of the work piece
  Eigen::VectorXd day;     ///< these effects
};

/// Returns whether rows have weight, rows x joints: their standard deviation is not far above the least one
/// of their joint, as that of lost and of silent rows is.
JointMask rows_with_weight(const LogFit& fit);

/// Returns the rows of a log before any change (first_change()).
CalmRows calm_rows(const LogFit& fit);

/// Estimates the noise of a log, by joint at least that of the healthy logs: a robot may have what no healthy
/// log had, such as friction that depends on load, and residuals from the first row on are no evidence for a
/// fault that begins later. The noise of a joint is the lower of two estimates: from the calm_rows(), which
/// a fault that lasts does not reach, and from all rows but outliers, which short faults do not reach.
RowNoise own_noise(const LogFit& fit);

}  // namespace faultline
