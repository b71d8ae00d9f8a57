// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "lib/neural/mlp.hpp"

namespace faultline {

/// Mean over the patterns of J^T H J, with J the Jacobian of the last layer's weighted sums by the parameters
/// (in the order of parameters_of()) and H the Hessian of the loss by those sums: the generalised
/// Gauss-Newton matrix. Only the lower triangle is filled. Without weight decay.
Eigen::MatrixXd gauss_newton_matrix(const Mlp& mlp, const Eigen::Ref<const Eigen::MatrixXd>& inputs);

/// The same from dense Jacobians for any network; reference for the test of the fast path.
Eigen::MatrixXd dense_gauss_newton_matrix(const Mlp& mlp, const Eigen::Ref<const Eigen::MatrixXd>& inputs);

}  // namespace faultline
