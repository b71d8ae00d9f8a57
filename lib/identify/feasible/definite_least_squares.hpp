// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "lib/identify/feasible/body_shape.hpp"

namespace faultline {

/// The x that minimises |a x - y|^2 / 2 + prior * sum over blocks of the entropic divergence
/// tr(N^-1 X) - ln det(N^-1 X) of each block X(x) from its nominal N, over all x with positive definite
/// blocks (Lee, Wensing and Park 2020). The problem is convex; Newton's method along falling priors. Unknowns
/// outside the blocks must be told by `a`.
Eigen::VectorXd definite_least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& y,
                                       const std::vector<DefiniteBlock>& blocks, double prior);

}  // namespace faultline
