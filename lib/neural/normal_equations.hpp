// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>
#include <variant>

#include "lib/neural/mlp.hpp"

namespace faultline {

/// Mean over the patterns of J^T H J, with J the Jacobian of the last layer's weighted sums by the parameters
/// (in the order of parameters_of()) and H the Hessian of the loss by those sums: the generalised
/// Gauss-Newton matrix. Only the lower triangle is filled. Without weight decay. From dense Jacobians, for
/// any network.
Eigen::MatrixXd gauss_newton_matrix(const Mlp& mlp, const Eigen::Ref<const Eigen::MatrixXd>& inputs);

/// Blocks of the Gauss-Newton matrix of a network with one hidden layer and linear outputs (docs/neural.md).
struct TwoLayerBlocks {
  Eigen::MatrixXd front;     ///< G, of the first layer's weights and biases; lower triangle
  Eigen::MatrixXd coupling;  ///< C, hidden units and 1 x weights and biases of the first layer
  Eigen::MatrixXd own;       ///< of the weights and the bias of one output, the same for each; lower triangle
  Eigen::MatrixXd mix;       ///< weights of the outputs, outputs x hidden units
};

/// The normal equations of a Gauss-Newton step of a network with weight decay, for any damping.
class GaussNewtonSystem {
 public:
  GaussNewtonSystem(const Mlp& mlp, const Eigen::Ref<const Eigen::MatrixXd>& inputs, double weight_decay);

  /// Mean of the diagonal of the matrix.
  double mean_diagonal() const;

  /// Solves (matrix + damping I) step = -gradient. Empty if the matrix is not positive definite.
  std::optional<Eigen::VectorXd> step(const Eigen::VectorXd& gradient, double damping) const;

 private:
  double weight_decay_;
  std::variant<Eigen::MatrixXd, TwoLayerBlocks> matrix_;  ///< the first with the weight decay
};

}  // namespace faultline
