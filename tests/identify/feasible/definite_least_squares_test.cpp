// SPDX-License-Identifier: MIT
#include "lib/identify/feasible/definite_least_squares.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

namespace faultline {
namespace {

constexpr double kPrior = 1e-8;

/// The symmetric matrix [x0, x1; x1, x2].
DefiniteBlock symmetric() {
  const Eigen::Matrix2d first{{1.0, 0.0}, {0.0, 0.0}}, off{{0.0, 1.0}, {1.0, 0.0}},
      last{{0.0, 0.0}, {0.0, 1.0}};
  return {0, {first, off, last}, Eigen::Vector3d(1.0, 0.0, 1.0)};
}

/// Weighs the entries so that the distance is Frobenius' norm.
const Eigen::Matrix3d kFrobenius = Eigen::Vector3d(1.0, std::sqrt(2.0), 1.0).asDiagonal();

TEST(DefiniteLeastSquares, ADefiniteSolutionIsTheLeastSquaresSolution) {
  const Eigen::Vector3d truth(2.0, 0.5, 1.0);
  const Eigen::VectorXd x = definite_least_squares(kFrobenius, kFrobenius * truth, {symmetric()}, kPrior);
  EXPECT_TRUE(x.isApprox(truth, 1e-6)) << x.transpose();
}

TEST(DefiniteLeastSquares, AnIndefiniteTargetGivesTheNearestSemidefiniteMatrix) {
  const Eigen::Vector3d target(1.0, 2.0, 1.0);  // eigenvalues 3 and -1: the nearest has 3 and 0
  const Eigen::VectorXd x = definite_least_squares(kFrobenius, kFrobenius * target, {symmetric()}, kPrior);
  EXPECT_TRUE(x.isApprox(Eigen::Vector3d(1.5, 1.5, 1.5), 1e-4)) << x.transpose();
  const Eigen::Matrix2d m{{x[0], x[1]}, {x[1], x[2]}};
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(m).eigenvalues()[0], 0.0);
}

TEST(DefiniteLeastSquares, UndeterminedEntriesStayNominal) {
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(1, 4);
  a(0, 3) = 1.0;  // tells the number behind the block alone
  const Eigen::VectorXd x =
      definite_least_squares(a, Eigen::VectorXd::Constant(1, -7.0), {symmetric()}, 0.01);
  EXPECT_TRUE(x.isApprox(Eigen::Vector4d(1.0, 0.0, 1.0, -7.0), 1e-6)) << x.transpose();
}

TEST(DefiniteLeastSquares, TargetsOfAnySizeAreReached) {
  for (const double size : {1e-6, 1.0, 1e6}) {
    const Eigen::Vector3d truth = size * Eigen::Vector3d(2.0, -0.5, 1.0);
    const Eigen::MatrixXd a = kFrobenius * (1e4 / size);
    const Eigen::VectorXd x = definite_least_squares(a, a * truth, {symmetric()}, kPrior);
    EXPECT_TRUE(x.isApprox(truth, 1e-4)) << size << ": " << x.transpose();
  }
}

}  // namespace
}  // namespace faultline
