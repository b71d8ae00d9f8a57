// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

namespace faultline {

/// Computes the block of (J' J)^-1 for the last `trailing` columns of J, by QR factorisations of one group of
/// rows after the other. `groups` are the rows of J by group: first the columns that no other group has, if
/// any, then the trailing ones. Ceres' own covariance adds up in the order of threads, and that of
/// SuiteSparse depends on the BLAS installed. Returns false if J has not full rank.
bool trailing_covariance(const std::vector<Eigen::MatrixXd>& groups, Eigen::Index trailing,
                         Eigen::MatrixXd& out);

}  // namespace faultline
