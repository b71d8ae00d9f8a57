// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

// Decompositions of small dense matrices, compiled once: where they are templates in many files, they are
// most of the time to build.
namespace faultline {

/// Of a symmetric matrix: its lower triangle is read.
struct SymmetricEigen {
  Eigen::VectorXd values;   ///< ascending
  Eigen::MatrixXd vectors;  ///< a column each
};
SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& matrix);
/// The values alone.
Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& matrix);

/// Descending.
Eigen::VectorXd singular_values(const Eigen::MatrixXd& matrix);

/// The x of least |a x - b|; zero along directions that `a` does not see.
Eigen::VectorXd least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

/// The x of a x = b, and the inverse, of a symmetric definite matrix.
Eigen::VectorXd solve_definite(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);
Eigen::MatrixXd inverse_definite(const Eigen::MatrixXd& a);

}  // namespace faultline
