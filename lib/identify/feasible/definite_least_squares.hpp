// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

namespace faultline {

/// A symmetric matrix, linear in some of the unknowns, that must be positive definite.
struct DefiniteBlock {
  int first = 0;                       ///< index of its first unknown; its unknowns follow each other
  std::vector<Eigen::MatrixXd> basis;  ///< value of the block for one unit of each unknown
  Eigen::VectorXd nominal;             ///< its unknowns for the robot as given, with which it is definite

  int unknowns() const { return static_cast<int>(basis.size()); }
  Eigen::MatrixXd value(const Eigen::VectorXd& own_unknowns) const;
};

/// Returns the x that minimises |a x - y|^2 / 2 + prior * sum over blocks of the entropic divergence
/// tr(N^-1 X) - ln det(N^-1 X) of each block X(x) from its nominal N, over all x with positive definite
/// blocks (Lee, Wensing and Park 2020). The problem is convex; solved by Newton's method along falling
/// priors. `a` must determine the unknowns outside the blocks.
Eigen::VectorXd definite_least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& y,
                                       const std::vector<DefiniteBlock>& blocks, double prior);

}  // namespace faultline
