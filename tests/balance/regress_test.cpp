// SPDX-License-Identifier: MIT
#include "lib/balance/regress.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>

#include "lib/core/random.hpp"

namespace faultline {
namespace {

struct Problem {
  Eigen::MatrixXd columns = Eigen::MatrixXd(40, 3);
  Eigen::VectorXd rows = Eigen::VectorXd(40), precision = Eigen::Vector3d(0.5, 2.0, 8.0);
};

Problem drawn_problem() {
  Problem out;
  Random random(7);
  for (int k = 0; k < 40; ++k) {
    for (int i = 0; i < 3; ++i) out.columns(k, i) = random.normal();
    out.rows[k] = 0.7 * out.columns(k, 0) - 0.2 * out.columns(k, 2) + random.normal();
  }
  return out;
}

/// ln of the normal density of the rows, whose covariance is 1 + X P^-1 X', without rows / 2 ln(2 pi).
double log_density(const Problem& p) {
  const Eigen::MatrixXd covariance =
      Eigen::MatrixXd::Identity(40, 40) +
      p.columns * p.precision.cwiseInverse().asDiagonal() * p.columns.transpose();
  return -0.5 * p.rows.dot(covariance.ldlt().solve(p.rows)) - 0.5 * std::log(covariance.determinant());
}

TEST(Regress, LikelihoodIsTheDensityOfTheRows) {
  const Problem p = drawn_problem();
  const Regression r = regress(normal_equations(p.columns, p.rows), p.precision);
  EXPECT_NEAR(r.log_likelihood, log_density(p), 1e-9);
}

TEST(Regress, EstimateAndCovarianceAreThoseOfThePosterior) {
  const Problem p = drawn_problem();
  const Regression r = regress(normal_equations(p.columns, p.rows), p.precision);
  Eigen::MatrixXd posterior = p.columns.transpose() * p.columns;
  posterior.diagonal() += p.precision;
  EXPECT_LT((r.estimate - posterior.inverse() * p.columns.transpose() * p.rows).norm(), 1e-12);
  EXPECT_LT((r.covariance() - posterior.inverse()).norm(), 1e-12);
  EXPECT_NEAR(r.left, (p.rows - p.columns * r.estimate).squaredNorm(), 1e-9);
}

TEST(Regress, AReusedFactorOfTheFirstColumnsGivesTheSameRegression) {
  const Problem p = drawn_problem();
  const NormalEquations sums = normal_equations(p.columns, p.rows);
  const Regression whole = regress(sums, p.precision);
  for (const int known : {1, 2, 3}) {
    const Eigen::MatrixXd leading =
        posterior_factor(sums.matrix.topLeftCorner(known, known), p.precision.head(known));
    const Regression r = regress(sums, p.precision, leading);
    EXPECT_LT((r.estimate - whole.estimate).norm(), 1e-12) << known;
    EXPECT_LT((r.covariance() - whole.covariance()).norm(), 1e-12) << known;
    EXPECT_NEAR(r.log_likelihood, whole.log_likelihood, 1e-9) << known;
  }
  EXPECT_LT((whole.std() - whole.covariance().diagonal().cwiseSqrt()).norm(), 1e-12);
  EXPECT_LT((whole.covariance(1, 2) - whole.covariance().block(1, 1, 2, 2)).norm(), 1e-12);
}

TEST(Regress, AColumnThatExplainsNothingLowersTheLikelihood) {
  const Problem p = drawn_problem();
  Eigen::MatrixXd more(40, 4);
  Random random(8);
  more.leftCols(3) = p.columns;
  for (int k = 0; k < 40; ++k) more(k, 3) = random.normal();
  Eigen::VectorXd precision(4);
  precision << p.precision, 0.01;
  EXPECT_LT(regress(normal_equations(more, p.rows), precision).log_likelihood,
            regress(normal_equations(p.columns, p.rows), p.precision).log_likelihood);
}

TEST(RecursiveRegression, GivesTheSameEstimateAndSquaresAsOneRegressionOfAllRows) {
  constexpr int kRows = 40, kColumns = 5;
  Random random(3);
  Eigen::MatrixXd columns(kRows, kColumns);
  Eigen::VectorXd rows(kRows);
  for (int k = 0; k < kRows; ++k) {
    for (int c = 0; c < kColumns; ++c) columns(k, c) = c == 2 && k < 30 ? 0.0 : random.normal();
    rows[k] = 2.0 * random.normal();
  }
  const Eigen::VectorXd precision = Eigen::VectorXd::LinSpaced(kColumns, 1e-3, 10.0);
  RecursiveRegression recursive(precision);
  for (int k = 0; k < kRows; ++k) {
    std::vector<int> some = {0, 1, 2, 3, 4};
    if (k < 30) some.erase(some.begin() + 2);  // the third column is 0
    recursive.add(columns.row(k)(some).transpose(), some, rows[k]);
    const Regression all = regress(normal_equations(columns.topRows(k + 1), rows.head(k + 1)), precision);
    const double square = all.left + precision.dot(all.estimate.cwiseAbs2());
    EXPECT_LT((recursive.estimate() - all.estimate).cwiseAbs().maxCoeff(), 1e-9) << k;
    EXPECT_NEAR(recursive.square(), square, 1e-9 * square) << k;
  }
}

}  // namespace
}  // namespace faultline
