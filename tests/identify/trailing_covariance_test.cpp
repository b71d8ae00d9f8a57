// SPDX-License-Identifier: MIT
#include "lib/identify/shooting/trailing_covariance.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "lib/core/random.hpp"

namespace faultline {
namespace {

ceres::CRSMatrix compressed(const Eigen::MatrixXd& dense) {
  ceres::CRSMatrix out;
  out.num_rows = static_cast<int>(dense.rows());
  out.num_cols = static_cast<int>(dense.cols());
  for (Eigen::Index row = 0; row < dense.rows(); ++row) {
    out.rows.push_back(static_cast<int>(out.values.size()));
    for (Eigen::Index column = 0; column < dense.cols(); ++column)
      if (dense(row, column) != 0.0) {
        out.cols.push_back(static_cast<int>(column));
        out.values.push_back(dense(row, column));
      }
  }
  out.rows.push_back(static_cast<int>(out.values.size()));
  return out;
}

/// Two groups of rows, each with its own two columns; both with the last three.
Eigen::MatrixXd arrow() {
  Random random(2);
  Eigen::MatrixXd j = Eigen::MatrixXd::Zero(20, 7);
  for (int row = 0; row < 20; ++row) {
    for (int k = 0; k < 2; ++k) j(row, 2 * (row / 10) + k) = random.normal();
    for (int k = 4; k < 7; ++k) j(row, k) = 10.0 * random.normal();
  }
  return j;
}

TEST(TrailingCovariance, IsTheBlockOfTheInverse) {
  const Eigen::MatrixXd j = arrow();
  Eigen::MatrixXd covariance;
  ASSERT_TRUE(trailing_covariance(compressed(j), 4, covariance));
  const Eigen::MatrixXd expected = (j.transpose() * j).inverse().bottomRightCorner(3, 3);
  EXPECT_LT((covariance - expected).norm(), 1e-12 * expected.norm());
}

TEST(TrailingCovariance, ThereIsNoneWithoutFullRank) {
  Eigen::MatrixXd j = arrow();
  j.col(6) = j.col(5);
  Eigen::MatrixXd covariance;
  EXPECT_FALSE(trailing_covariance(compressed(j), 4, covariance));
}

}  // namespace
}  // namespace faultline
