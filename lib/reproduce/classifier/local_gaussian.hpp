// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace faultline {

/// Outputs as a linear function of the inputs and a Gaussian rest whose covariance is that of the known
/// patterns with the nearest inputs.
struct LocalGaussian {
  Eigen::MatrixXd trend;       ///< outputs x inputs
  Eigen::MatrixXd inputs;      ///< inputs x known patterns, divided by `scale`
  Eigen::MatrixXd rest;        ///< outputs x known patterns
  Eigen::VectorXd scale;       ///< rms of each input
  Eigen::MatrixXd covariance;  ///< of the rest, over all of them
};

/// Needs at least one pattern a column.
LocalGaussian fit_local_gaussian(const Eigen::MatrixXd& inputs, const Eigen::MatrixXd& outputs);
Eigen::VectorXd mean_at(const LocalGaussian& gaussian, const Eigen::VectorXd& input);
Eigen::MatrixXd covariance_at(const LocalGaussian& gaussian, const Eigen::VectorXd& input);

}  // namespace faultline
