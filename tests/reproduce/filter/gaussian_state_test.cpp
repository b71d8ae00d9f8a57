// SPDX-License-Identifier: MIT
#include "lib/reproduce/filter/gaussian_state.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "lib/core/random.hpp"

namespace faultline {
namespace {

Eigen::MatrixXd random_matrix(int size, Random& random) {
  Eigen::MatrixXd m(size, size);
  for (Eigen::Index i = 0; i < m.size(); ++i) m.data()[i] = random.normal();
  return m;
}

Eigen::MatrixXd covariance_of(const GaussianState& state) {
  Eigen::MatrixXd p(state.size, state.size);
  for (int i = 0; i < state.size; ++i)
    for (int j = 0; j < state.size; ++j) p(i, j) = state.p(i, j);
  return p;
}

Eigen::VectorXd mean_of(const GaussianState& state) {
  return Eigen::Map<const Eigen::VectorXd>(state.mean.data(), state.size);
}

GaussianState random_state(int size, Random& random) {
  const Eigen::MatrixXd root = random_matrix(size, random);
  const Eigen::MatrixXd p = root * root.transpose() + Eigen::MatrixXd::Identity(size, size);
  GaussianState state;
  state.size = size;
  for (int i = 0; i < size; ++i) {
    state.mean[i] = random.normal();
    for (int j = 0; j < size; ++j) state.p(i, j) = p(i, j);
  }
  return state;
}

/// The update written with whole matrices (Joseph's form).
void expect_update(const GaussianState& before, const GaussianState& after, const Eigen::RowVectorXd& h,
                   double z, double noise, const ScalarUpdate& update) {
  const Eigen::MatrixXd p = covariance_of(before);
  const double variance = (h * p * h.transpose())(0) + noise;
  const Eigen::VectorXd gain = p * h.transpose() / variance;
  const double innovation = z - (h * mean_of(before))(0);
  const Eigen::MatrixXd left = Eigen::MatrixXd::Identity(before.size, before.size) - gain * h;
  const Eigen::MatrixXd expected = left * p * left.transpose() + noise * gain * gain.transpose();
  EXPECT_NEAR(update.innovation, innovation, 1e-12);
  EXPECT_NEAR(update.variance, variance, 1e-12 * variance);
  EXPECT_NEAR(update.chi_square(), innovation * innovation / variance, 1e-9);
  EXPECT_LT((mean_of(after) - mean_of(before) - gain * innovation).norm(), 1e-11);
  EXPECT_LT((covariance_of(after) - expected).norm(), 1e-10);
}

TEST(GaussianState, UpdateIsTheDenseKalmanUpdate) {
  Random random(3);
  for (const int size : {2, 6, 9}) {
    const GaussianState before = random_state(size, random);
    GaussianState after = before;
    Eigen::RowVectorXd h = Eigen::RowVectorXd::Zero(size);
    h[1] = 1.0;
    expect_update(before, after, h, 0.7, 0.3, observe(after, 1, -1, 0.0, 0.7, 0.3));
  }
}

TEST(GaussianState, UpdateThroughAFaultySensor) {
  Random random(4);
  const GaussianState before = random_state(7, random);
  GaussianState after = before;
  Eigen::RowVectorXd h = Eigen::RowVectorXd::Zero(7);
  h[2] = 1.0;
  h[6] = -1.7;
  expect_update(before, after, h, -0.2, 0.05, observe(after, 2, 6, -1.7, -0.2, 0.05));
}

TEST(GaussianState, PropagationIsTheDenseProduct) {
  Random random(5);
  GaussianState state = random_state(8, random);
  const Eigen::MatrixXd p = covariance_of(state), a = random_matrix(8, random);
  const Eigen::Matrix<double, 8, 8, Eigen::RowMajor> rows = a;
  propagate_covariance(state, std::span(rows.data(), rows.size()), 8);
  EXPECT_LT((covariance_of(state) - a * p * a.transpose()).norm(), 1e-10);
  EXPECT_EQ(covariance_of(state), covariance_of(state).transpose());
}

TEST(GaussianState, NumbersBehindTheMovingOnesStay) {
  Random random(7);
  GaussianState state = random_state(8, random);
  const Eigen::MatrixXd p = covariance_of(state);
  Eigen::MatrixXd a = Eigen::MatrixXd::Identity(8, 8);
  a.topRows(5) = random_matrix(8, random).topRows(5);
  const Eigen::Matrix<double, 5, 8, Eigen::RowMajor> rows = a.topRows(5);
  propagate_covariance(state, std::span(rows.data(), rows.size()), 5);
  EXPECT_LT((covariance_of(state) - a * p * a.transpose()).norm(), 1e-10);
  EXPECT_EQ(covariance_of(state), covariance_of(state).transpose());
}

TEST(GaussianState, WhatIsForgottenLosesItsMeanAndItsTies) {
  Random random(8);
  GaussianState state = random_state(4, random);
  const Eigen::MatrixXd p = covariance_of(state);
  const Eigen::VectorXd x = mean_of(state);
  Eigen::MatrixXd kept = Eigen::MatrixXd::Identity(4, 4);
  kept(2, 2) = 0.3;
  relax(state, 2, 0.3);
  EXPECT_LT((mean_of(state) - kept * x).norm(), 1e-14);
  EXPECT_LT((covariance_of(state) - kept * p * kept).norm(), 1e-13);
}

TEST(GaussianState, ExtensionKeepsTheStateAndAddsZeros) {
  Random random(6);
  const GaussianState state = random_state(4, random), more = extended(state, 6);
  ASSERT_EQ(more.size, 6);
  EXPECT_EQ(mean_of(more).head(4), mean_of(state));
  EXPECT_EQ(mean_of(more).tail(2), Eigen::VectorXd::Zero(2));
  EXPECT_EQ(covariance_of(more).topLeftCorner(4, 4), covariance_of(state));
  EXPECT_EQ(covariance_of(more).rightCols(2), Eigen::MatrixXd::Zero(6, 2));
}

}  // namespace
}  // namespace faultline
