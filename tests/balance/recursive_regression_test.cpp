// SPDX-License-Identifier: MIT
#include "lib/balance/recursive_regression.hpp"

#include <gtest/gtest.h>

#include "lib/balance/regress.hpp"
#include "lib/core/random.hpp"

namespace faultline {
namespace {

TEST(RecursiveRegression, GivesTheEstimateAndTheSquaresOfAllRowsAtOnce) {
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
