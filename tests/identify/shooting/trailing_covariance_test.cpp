// SPDX-License-Identifier: MIT
#include "lib/identify/shooting/trailing_covariance.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "lib/core/random.hpp"

namespace faultline {
namespace {

/// Two groups of rows, each with two columns of its own, then three that both have.
std::vector<Eigen::MatrixXd> arrow() {
  Random random(2);
  std::vector<Eigen::MatrixXd> groups(2, Eigen::MatrixXd(10, 5));
  for (Eigen::MatrixXd& group : groups)
    for (int row = 0; row < 10; ++row)
      for (int k = 0; k < 5; ++k) group(row, k) = (k < 2 ? 1.0 : 10.0) * random.normal();
  return groups;
}

TEST(TrailingCovariance, IsTheBlockOfTheInverse) {
  const std::vector<Eigen::MatrixXd> groups = arrow();
  Eigen::MatrixXd covariance;
  ASSERT_TRUE(trailing_covariance(groups, 3, covariance));
  Eigen::MatrixXd j = Eigen::MatrixXd::Zero(20, 7);
  for (int i = 0; i < 2; ++i) {
    j.block(10 * i, 2 * i, 10, 2) = groups[i].leftCols(2);
    j.block(10 * i, 4, 10, 3) = groups[i].rightCols(3);
  }
  const Eigen::MatrixXd expected = (j.transpose() * j).inverse().bottomRightCorner(3, 3);
  EXPECT_LT((covariance - expected).norm(), 1e-12 * expected.norm());
}

TEST(TrailingCovariance, DoesNotExistWithoutFullRank) {
  std::vector<Eigen::MatrixXd> groups = arrow();
  for (Eigen::MatrixXd& group : groups) group.col(4) = group.col(3);
  Eigen::MatrixXd covariance;
  EXPECT_FALSE(trailing_covariance(groups, 3, covariance));
}

}  // namespace
}  // namespace faultline
