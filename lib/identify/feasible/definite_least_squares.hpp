// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "lib/identify/feasible/body_shape.hpp"

namespace faultline {

/// Returns the x that minimises |a x - y|^2 / 2 + prior * sum over blocks of the entropic divergence
/// tr(N^-1 X) - ln det(N^-1 X) of each block X(x) from its nominal N, over all x with positive definite
/// blocks (Lee, Wensing and Park 2020). The problem is convex; solved by Newton's method along falling
/// priors. `a` must determine the unknowns outside the blocks.
Eigen::VectorXd definite_least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& y,
                                       const std::vector<DefiniteBlock>& blocks, double prior);

}  // namespace faultline
