// SPDX-License-Identifier: MIT
#include "lib/balance/work_piece.hpp"

#include <gtest/gtest.h>

#include "lib/core/random.hpp"

namespace faultline {
namespace {

constexpr int kRows = 400;

Eigen::MatrixXd carried(int from, int to, double noise) {
  Random random(3);
  Eigen::MatrixXd out(kRows, 1);
  for (int k = 0; k < kRows; ++k) out(k, 0) = (k >= from && k < to ? 2.0 : 0.0) + noise * random.normal();
  return out;
}

TEST(WorkPiecePath, FindsWhenAWorkPieceIsPickedUpAndPutDown) {
  const PiecePath path = piece_path(carried(120, 300, 0.5), Eigen::MatrixXd::Constant(kRows, 1, 2.0),
                                    Eigen::MatrixXd::Constant(kRows, 1, 0.5));
  for (int k = 0; k < kRows; ++k) {
    if (std::abs(k - 120) <= 3 || std::abs(k - 300) <= 3) continue;
    EXPECT_EQ(path[k], k >= 120 && k < 300) << k;
  }
}

TEST(WorkPiecePath, ASingleOutlierChangesNoLevel) {
  Eigen::MatrixXd residual = carried(0, 0, 0.5);
  residual(200, 0) = 50.0;
  const PiecePath path = piece_path(residual, Eigen::MatrixXd::Constant(kRows, 1, 2.0),
                                    Eigen::MatrixXd::Constant(kRows, 1, 0.5));
  for (const char level : path) EXPECT_EQ(level, 0);
}

TEST(WorkPiecePath, RampsJoinSuccessiveLevels) {
  PiecePath path(kRows, 0);
  for (int k = 200; k < kRows; ++k) path[k] = 1;
  const Eigen::VectorXd time = Eigen::VectorXd::LinSpaced(kRows, 0.0, 0.01 * (kRows - 1));
  const PieceRamps ramps = piece_ramps(path, time, 0.02);
  ASSERT_EQ(ramps.change.cols(), 1);
  EXPECT_NEAR(ramps.level[100], 0.0, 1e-12);
  EXPECT_NEAR(ramps.level[300], 1.0, 1e-12);
  EXPECT_NEAR(ramps.change.sum() * 0.01, 1.0, 1e-6);  // its integral over time is the step
}

}  // namespace
}  // namespace faultline
