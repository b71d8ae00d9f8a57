// SPDX-License-Identifier: MIT
#pragma once

#include <ceres/crs_matrix.h>

#include <Eigen/Core>

namespace faultline {

/// The block of (J' J)^-1 that belongs to the columns of J from `first` on, by a sparse QR factorisation; on
/// the calling thread alone, which Ceres' own covariance is not. False when J has not full rank.
bool trailing_covariance(const ceres::CRSMatrix& jacobian, int first, Eigen::MatrixXd& out);

}  // namespace faultline
