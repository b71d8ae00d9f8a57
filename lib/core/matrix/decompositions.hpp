// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

// Decompositions of small dense matrices, compiled once: as templates in many files they take most of the
// time to build.
namespace faultline {

/// Eigenvalues and eigenvectors of a symmetric matrix, of which the lower triangle is used.
struct SymmetricEigen {
  Eigen::VectorXd values;   ///< ascending
  Eigen::MatrixXd vectors;  ///< one in each column
};
SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& matrix);
/// Returns the eigenvalues alone, ascending.
Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& matrix);

/// Returns the singular values, descending.
Eigen::VectorXd singular_values(const Eigen::MatrixXd& matrix);

/// Returns the x of least |a x - b|; zero for columns of `a` that depend on its other ones.
Eigen::VectorXd least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

/// Return the x of a x = b, and the inverse, of a symmetric definite matrix.
Eigen::VectorXd solve_definite(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);
Eigen::MatrixXd inverse_definite(const Eigen::MatrixXd& a);

}  // namespace faultline
