// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

namespace faultline {

/// Consecutive windows of one joint in one log as its own fit left them.
struct ResidualRun {
  Eigen::MatrixXd a;         ///< windows x fitted parameters
  Eigen::VectorXd weight;    ///< of each in the fit
  Eigen::VectorXd residual;  ///< N m or N
  std::vector<double> time_s;
};

/// Mean product of residuals so many windows apart, from 0 on, over the runs of one joint, tapered to zero
/// (Newey and West 1987). Windows that a fit weighs down do not count.
std::vector<double> autocovariance(const std::vector<const ResidualRun*>& runs);

/// What residuals of that autocovariance add to the covariance of a run's weighted sum a^T W r.
Eigen::MatrixXd covariance_of_sum(const ResidualRun& run, const std::vector<double>& autocovariance);

}  // namespace faultline
