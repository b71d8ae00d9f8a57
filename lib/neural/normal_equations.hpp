// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>

#include "lib/neural/mlp.hpp"
#include "lib/neural/patterns.hpp"

namespace faultline {

/// Mean over the patterns of J^T H J, with J the Jacobian of the last layer's weighted sums by the parameters
/// (in the order of parameters_of()) and H the Hessian of the loss by those sums: the generalised
/// Gauss-Newton matrix. Only the lower triangle is filled. Without weight decay. From dense Jacobians, for
/// any network.
Eigen::MatrixXd gauss_newton_matrix(const Mlp& mlp, const Eigen::Ref<const Eigen::MatrixXd>& inputs);

/// Returns whether the outputs are linear functions of one hidden layer, so that a linear regression fits
/// their weights exactly.
bool has_projected_outputs(const Mlp& mlp);

/// Returns the last layer that minimises the loss over the patterns with weight decay while the hidden layer
/// stays as it is: a ridge regression on the hidden units. Only for networks with has_projected_outputs().
MlpLayer fitted_outputs(const Mlp& mlp, const Patterns& patterns, double weight_decay);

/// The normal equations of a Gauss-Newton step of a network with weight decay, for any damping. If
/// has_projected_outputs(), the step moves the hidden layer alone, and the matrix takes into account that
/// fitted_outputs() follow (variable projection in Kaufman's form; docs/neural.md).
class GaussNewtonSystem {
 public:
  GaussNewtonSystem(const Mlp& mlp, const Eigen::Ref<const Eigen::MatrixXd>& inputs, double weight_decay);

  double mean_diagonal() const { return matrix_.diagonal().mean(); }

  /// Solves (matrix + damping I) step = -gradient, with zeros for outputs that are fitted. `gradient` has all
  /// parameters. Empty if the matrix is not positive definite.
  std::optional<Eigen::VectorXd> step(const Eigen::VectorXd& gradient, double damping) const;

 private:
  Eigen::MatrixXd matrix_;  ///< of the first parameters, all or those of the hidden layer; lower triangle
};

}  // namespace faultline
