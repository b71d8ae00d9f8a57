// SPDX-License-Identifier: MIT
#pragma once

#include <ceres/ceres.h>

#include <Eigen/Core>
#include <vector>

#include "lib/identify/shooting_evaluation.hpp"

namespace faultline {

/// Covariance of the free parameters when the residuals are white, by Ceres; false when it is singular.
bool white_covariance(ceres::Problem& costs, ShootingEvaluation& evaluation, Eigen::MatrixXd& out);

/// Sandwich over blocks of about a second: what the residuals' own correlation says of the spread.
Eigen::MatrixXd sandwich(const ShootingEvaluation& evaluation, const std::vector<Excerpt>& excerpts,
                         const Eigen::MatrixXd& white);

/// The white covariance with every std at least that of the sandwich; `widened` is the largest factor.
Eigen::MatrixXd widen(const Eigen::MatrixXd& white, const Eigen::MatrixXd& robust, double& widened);

}  // namespace faultline
