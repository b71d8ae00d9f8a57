// SPDX-License-Identifier: MIT
#pragma once

#include <ceres/crs_matrix.h>

#include <Eigen/Core>

namespace faultline {

/// Computes the block of (J' J)^-1 for the columns of J from `first` on, by QR factorisations of the rows
/// that share columns before `first`, one group after the other. Ceres' own covariance adds up in the order
/// of threads, and that of SuiteSparse depends on the BLAS installed. Returns false if J has not full rank.
bool trailing_covariance(const ceres::CRSMatrix& jacobian, int first, Eigen::MatrixXd& out);

}  // namespace faultline
