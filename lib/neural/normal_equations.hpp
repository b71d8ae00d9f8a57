// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>

#include "lib/neural/mlp.hpp"
#include "lib/neural/patterns.hpp"

/// Least squares for networks with one hidden layer and linear outputs: a step moves the hidden layer alone,
/// and the outputs follow by regression (variable projection in Kaufman's form; docs/neural.md).
namespace faultline {

/// Returns the last layer that minimises the loss over the patterns with weight decay while the hidden layer
/// stays as it is: a ridge regression on the hidden units.
MlpLayer fitted_outputs(const Mlp& mlp, const Patterns& patterns, double weight_decay);

/// Returns the normal matrix of a Gauss-Newton step of the hidden layer, of its weights and then its biases;
/// only the lower triangle is filled.
Eigen::MatrixXd hidden_layer_matrix(const Mlp& mlp, const Eigen::Ref<const Eigen::MatrixXd>& inputs,
                                    double weight_decay);

/// Solves (matrix + damping I) step = -gradient, with zeros for the outputs. `gradient` has all parameters.
/// Empty if the matrix is not positive definite.
std::optional<Eigen::VectorXd> gauss_newton_step(Eigen::MatrixXd matrix, const Eigen::VectorXd& gradient,
                                                 double damping);

}  // namespace faultline
