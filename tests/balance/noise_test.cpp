// SPDX-License-Identifier: MIT
#include "lib/balance/noise.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <random>
#include <utility>

namespace faultline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Eigen::Index kRows = 40;

/// Noise that wanders: autocovariance exp(-lag / 12), with a part that does not.
JointNoise wandering_noise(Eigen::Index order) {
  VectorXd covariance(order + 1);
  for (Eigen::Index lag = 0; lag <= order; ++lag)
    covariance[lag] = std::exp(-static_cast<double>(lag) / 12.0) + (lag == 0 ? 0.05 : 0.0);
  JointNoise white;
  white.base = 1.0;
  return with_autocovariance(white, covariance);
}

/// Returns the autocovariance of an autoregression at a lag, by its response to one innovation.
double covariance_at(const JointNoise& noise, Eigen::Index lag) {
  constexpr Eigen::Index kLong = 2000;
  VectorXd response = VectorXd::Zero(kLong);
  for (Eigen::Index k = 0; k < kLong; ++k) {
    response[k] = k == 0 ? noise.innovation : 0.0;
    for (Eigen::Index i = 1; i < noise.filter.size() && i <= k; ++i)
      response[k] -= noise.filter[i] * response[k - i];
  }
  return response.head(kLong - lag).dot(response.tail(kLong - lag));
}

/// Returns the covariance of the rows with weight, with their standard deviations.
MatrixXd covariance_of(const VectorXd& std, const JointNoise& noise) {
  MatrixXd out(std.size(), std.size());
  for (Eigen::Index i = 0; i < std.size(); ++i)
    for (Eigen::Index k = 0; k < std.size(); ++k)
      out(i, k) = std[i] * std[k] * covariance_at(noise, std::abs(i - k));
  return out;
}

VectorXd uneven_std() {
  return VectorXd::NullaryExpr(kRows, [](Eigen::Index k) { return 1.0 + 0.5 * std::sin(0.4 * double(k)); });
}

/// Returns X' inv(C) X of the rows `kept`.
MatrixXd exact(const MatrixXd& x, const MatrixXd& covariance, const std::vector<Eigen::Index>& kept) {
  const MatrixXd some = x(kept, Eigen::all);
  return some.transpose() * covariance(kept, kept).llt().solve(some);
}

MatrixXd some_columns() {
  MatrixXd out(kRows, 3);
  for (Eigen::Index k = 0; k < kRows; ++k)
    out.row(k) << 1.0, std::sin(0.3 * double(k)), double(k * 7 % 11) - 5.0;
  return out;
}

TEST(Noise, AWhitenedLogHasTheExactEvidenceOfItsCovariance) {
  const JointNoise noise = wandering_noise(3);
  const VectorXd std = uneven_std();
  std::vector<Eigen::Index> all;
  for (Eigen::Index k = 0; k < kRows; ++k) all.push_back(k);
  const MatrixXd x = some_columns(), white = Whitener(std, noise)(x);
  EXPECT_TRUE((white.transpose() * white).isApprox(exact(x, covariance_of(std, noise), all), 1e-9));
}

TEST(Noise, RowsWithoutWeightKeepTheExactEvidenceOfTheOtherRows) {
  const JointNoise noise = wandering_noise(1);
  VectorXd std = uneven_std();
  std::vector<Eigen::Index> kept;
  for (Eigen::Index k = 0; k < kRows; ++k)
    if (k == 9 || (k > 20 && k < 29))
      std[k] = kNoWeight;
    else
      kept.push_back(k);
  const MatrixXd x = some_columns(), white = Whitener(std, noise)(x);
  EXPECT_TRUE(white.row(9).isZero(0.0));
  const MatrixXd square = white.transpose() * white,
                 right = exact(x, covariance_of(uneven_std(), noise), kept);
  EXPECT_TRUE(square.isApprox(right, 1e-9)) << square << "\n" << right;
}

TEST(Noise, TheFirstRowOfALogIsWhitenedByItsFullVariance) {
  const JointNoise noise = wandering_noise(3);
  VectorXd level = VectorXd::Ones(kRows);
  const VectorXd white = Whitener(VectorXd::Ones(kRows), noise)(level);
  EXPECT_NEAR(white[0], 1.0 / std::sqrt(autocovariance(noise)[0]), 1e-9);
  EXPECT_GT(white[0], 0.9);
  EXPECT_LT(white[0], 1.1);
  EXPECT_GT(1.0 / noise.innovation, 1.5) << "as if the rows before it had been zero";
}

TEST(Noise, ColumnsThatBeginLaterAreWhitenedLikeCompleteColumns) {
  const JointNoise noise = wandering_noise(3);
  VectorXd std = uneven_std();
  std[12] = kNoWeight;
  MatrixXd x = some_columns();
  x.topRows(11).setZero();
  const Whitener white(std, noise);
  EXPECT_TRUE(white.of(x.bottomRows(kRows - 11), 11).isApprox(white(x).bottomRows(kRows - 11), 1e-12));
}

TEST(Noise, AValueOfARowReachesOnlyTheNextThreeRowsWithWeight) {
  VectorXd std = VectorXd::Ones(kRows);
  std[11] = kNoWeight;
  const Whitener white(std, wandering_noise(3));
  MatrixXd x = MatrixXd::Zero(kRows, 1);
  x(9, 0) = 1.0;
  const MatrixXd whitened = white(x);
  EXPECT_EQ(white.reach(10), 14);
  EXPECT_NE(whitened(13, 0), 0.0);
  EXPECT_TRUE(whitened.bottomRows(kRows - 14).isZero(0.0));
  EXPECT_EQ(white.reach(kRows - 1), kRows);
}

constexpr int kManyRows = 6000;
constexpr double kQuiet = 0.02,
                 kShaken = 0.2;  // N m: of a joint beside one that rests, and beside one that moves

/// Rows of two joints, of which the second one moves at 2 rad/s in every other stretch of 100 rows.
BalanceRows rows_beside_a_joint_that_moves() {
  BalanceRows out;
  out.time_s = VectorXd::LinSpaced(kManyRows, 0.0, 0.03 * kManyRows);
  out.torque = out.q = out.step_square = MatrixXd::Zero(kManyRows, 2);
  out.dq = MatrixXd::Zero(kManyRows, 2);
  for (int k = 0; k < kManyRows; ++k) out.dq(k, 1) = k / 100 % 2 == 0 ? 0.0 : 2.0;
  out.lost.assign(kManyRows, false);
  return out;
}

/// Residuals of joint 1: a level that wanders by 1 N m over some 300 rows, and white noise, ten times as
/// large while joint 2 moves.
MatrixXd wandering_and_shaken(const BalanceRows& rows) {
  std::mt19937 random(3);
  const auto normal = [&] { return std::normal_distribution<>()(random); };
  constexpr double kKept = 0.9967;
  MatrixXd out = MatrixXd::Zero(kManyRows, 2);
  double level = 0.0;
  for (int k = 0; k < kManyRows; ++k) {
    level = kKept * level + std::sqrt(1.0 - kKept * kKept) * normal() * 0.1;
    out(k, 0) = level + (rows.dq(k, 1) > 0.0 ? kShaken : kQuiet) * normal();
  }
  return out;
}

/// Returns the mean square of the whitened residuals of joint 1 beside the other joint at rest, and in
/// motion.
Eigen::Vector2d mean_squares(const BalanceRows& rows, const MatrixXd& residual, const MatrixXd& std,
                             const RowNoise& noise) {
  const VectorXd white = Whitener(std.col(0), noise.joint[0])(residual.col(0));
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (int k = 0; k < kManyRows; ++k) sum[rows.dq(k, 1) > 0.0] += white[k] * white[k];
  return sum / (kManyRows / 2);
}

TEST(Noise, AJointThatAnotherOneShakesIsLoudOnlyWhileThatOneMoves) {
  const BalanceRows rows = rows_beside_a_joint_that_moves();
  RowSetting setting;
  setting.friction_width = VectorXd::Constant(2, 0.05);
  LogResidual log{&rows, wandering_and_shaken(rows), {}, {}};
  RowNoise noise;
  for (int round = 0; round < 3; ++round) {
    noise = with_variance({log}, setting, std::move(noise));
    log.std = row_std(rows, setting, noise, VectorXd::Ones(2));
    noise = with_filter({log}, 3, std::move(noise));
  }
  EXPECT_GT(noise.joint[0].others, 0.0);
  const Eigen::Vector2d square = mean_squares(rows, log.torque, log.std, noise);
  EXPECT_NEAR(square[0], 1.0, 0.5) << "beside a joint that rests";
  EXPECT_NEAR(square[1], 1.0, 0.3) << "beside a joint that moves";
}

}  // namespace
}  // namespace faultline
