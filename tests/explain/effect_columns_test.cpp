// SPDX-License-Identifier: MIT
// Sums over the columns of each joint equal those over the stacked columns.
#include "lib/explain/effect_columns.hpp"

#include <gtest/gtest.h>

#include "lib/core/random.hpp"

namespace faultline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kRows = 30, kJoints = 3, kEffects = 5;

/// By joint, rows x effects: the first effect reaches every joint, each other one a single joint.
std::vector<MatrixXd> some_columns() {
  Random random(4);
  std::vector<MatrixXd> out(kJoints, MatrixXd::Zero(kRows, kEffects));
  for (int j = 0; j < kJoints; ++j)
    for (int e = 0; e < kEffects; ++e)
      for (int k = 0; k < kRows && (e == 0 || e % kJoints == j); ++k) out[j](k, e) = random.normal();
  return out;
}

StackedColumns stacked_columns(const std::vector<MatrixXd>& columns) {
  StackedColumns out(kJoints * kRows, columns.front().cols());
  for (int j = 0; j < kJoints; ++j) out.middleRows(j * kRows, kRows) = columns[j];
  return out;
}

void expect_equal(const MatrixXd& a, const MatrixXd& b) {
  ASSERT_EQ(a.rows(), b.rows());
  ASSERT_EQ(a.cols(), b.cols());
  EXPECT_LT((a - b).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(EffectColumns, KeepOnlyTheColumnsThatReachAJoint) {
  const EffectColumns effects(some_columns());
  EXPECT_EQ(effects.reach(0), (std::vector<int>{0, 3}));
  EXPECT_EQ(effects.reach(1), (std::vector<int>{0, 1, 4}));
  EXPECT_EQ(effects.reach(2), (std::vector<int>{0, 2}));
  for (int j = 0; j < kJoints; ++j) expect_equal(effects.all(j), some_columns()[j]);
}

TEST(EffectColumns, GiveTheSumsOfTheStackedColumns) {
  const EffectColumns effects(some_columns());
  const StackedColumns x = stacked_columns(some_columns());
  const MatrixXd others = MatrixXd::Random(kJoints * kRows, 2);
  expect_equal(effects.square(), x.transpose() * x);
  expect_equal(effects.along(others), x.transpose() * others);
  const VectorXd sizes = VectorXd::Random(kEffects);
  expect_equal(effects.times(sizes), x * sizes);
}

TEST(EffectColumns, GiveTheSumsOfSomeRows) {
  const EffectColumns effects(some_columns());
  const StackedColumns x = stacked_columns(some_columns());
  StackedMask only(kJoints * kRows, false);
  std::vector<int> marked;
  for (const int row : {0, 7, kRows - 1, kRows + 3, 2 * kRows + 20}) {
    only[row] = true;
    marked.push_back(row);
  }
  const MatrixXd some = x(marked, Eigen::all);
  expect_equal(effects.square(only), some.transpose() * some);

  constexpr int kBegin = 12, kCount = 6;
  const MatrixXd torque = MatrixXd::Random(kCount, kJoints);
  VectorXd sum = VectorXd::Zero(kEffects);
  for (int j = 0; j < kJoints; ++j)
    sum += x.middleRows(j * kRows + kBegin, kCount).transpose() * torque.col(j);
  expect_equal(effects.along(torque, kBegin), sum);
}

TEST(EffectColumns, AnAppendedColumnIsAnEffectOfTheJointsThatItReaches) {
  EffectColumns effects(some_columns());
  StackedColumns more = StackedColumns::Zero(kJoints * kRows, 2);
  more.col(0).segment(kRows, kRows) = VectorXd::Random(kRows);
  more.col(1) = VectorXd::Random(kJoints * kRows);
  effects.append(more);
  EXPECT_EQ(effects.effects(), kEffects + 2);
  EXPECT_EQ(effects.reach(0), (std::vector<int>{0, 3, 6}));
  EXPECT_EQ(effects.reach(1), (std::vector<int>{0, 1, 4, 5, 6}));
  StackedColumns x(kJoints * kRows, kEffects + 2);
  x << stacked_columns(some_columns()), more;
  expect_equal(effects.square(), x.transpose() * x);
}

}  // namespace
}  // namespace faultline
