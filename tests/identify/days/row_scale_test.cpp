// SPDX-License-Identifier: MIT
// Sine motion with white noise, whose best kernel has a closed form.
#include "lib/identify/days/row_scale.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lib/core/random.hpp"

namespace faultline {
namespace {

constexpr double kReach = 0.5, kRate = 3.0;  // rad, rad/s

struct Noise {
  double q = 0.0, dq = 0.0;  ///< rad, rad/s
};

/// One joint that moves, with its measured velocity, and one that rests.
std::vector<UniformLog> moving_and_resting(double period_s, const Noise& noise) {
  Random random(3);
  UniformLog log;
  log.period_s = period_s;
  const int rows = static_cast<int>(20.0 / period_s);
  log.q = log.dq = log.tau = Eigen::MatrixXd::Zero(rows, 2);
  for (int k = 0; k < rows; ++k) {
    const double at = kRate * period_s * k;
    log.q.row(k) << kReach * std::sin(at) + noise.q * random.normal(), noise.q * random.normal();
    log.dq.row(k) << kReach * kRate * std::cos(at) + noise.dq * random.normal(), noise.dq * random.normal();
  }
  log.lost.assign(rows, false);
  log.q_noise = Eigen::Vector2d::Constant(noise.q);
  log.dq_noise = Eigen::Vector2d::Constant(noise.dq);
  return {log};
}

std::vector<UniformLog> without_velocity(std::vector<UniformLog> logs) {
  for (UniformLog& log : logs) log.dq.resize(0, 0);
  return logs;
}

const std::vector<bool> kMeasured = {false, false}, kDerived = {true, true};

TEST(RowScale, LittleNoiseNeedsTheShortestKernelOfTheRate) {
  const RowScale fast = row_scale(moving_and_resting(0.001, {5e-5, 3e-3}), kMeasured);
  EXPECT_EQ(fast.kernel_s, 0.012);
  EXPECT_EQ(fast.friction_s, 0.006);
  EXPECT_EQ(fast.averaged, 2);
  const RowScale slow = row_scale(moving_and_resting(0.01, {5e-5, 3e-3}), kMeasured);
  EXPECT_EQ(slow.kernel_s, 0.016);
  EXPECT_EQ(slow.averaged, 1);
}

TEST(RowScale, ACoarseEncoderNeedsAKernelWhoseAccelerationHasFivePercentNoise) {
  const double period_s = 0.002, noise = 9e-4;
  const RowScale scale = row_scale(without_velocity(moving_and_resting(period_s, {noise, 0.0})), kMeasured);
  const double acceleration = kReach * kRate * kRate / std::numbers::sqrt2;
  const double white = noise * noise * period_s * 3.0 / (8.0 * std::sqrt(std::numbers::pi));
  const double best_s = std::pow(white / std::pow(0.05 * acceleration, 2.0), 0.2);
  EXPECT_GE(scale.kernel_s, best_s);
  EXPECT_LE(scale.kernel_s, 1.25 * best_s);
  EXPECT_NEAR(scale.friction_s / scale.kernel_s, 0.5, 1e-9);
  EXPECT_EQ(scale.averaged, static_cast<int>(scale.kernel_s / 6.0 / period_s + 0.1));
}

TEST(RowScale, AMeasuredVelocityReplacesACoarseEncoderUnlessItWasDerivedFromIt) {
  const std::vector<UniformLog> logs = moving_and_resting(0.002, {9e-4, 3e-3});
  EXPECT_EQ(row_scale(logs, kMeasured).kernel_s, 0.012);
  EXPECT_GT(row_scale(logs, kDerived).kernel_s, 0.02);
}

TEST(RowScale, TheKernelHasABoundAndARestingJointDoesNotWidenIt) {
  std::vector<UniformLog> logs = without_velocity(moving_and_resting(0.002, {0.02, 0.0}));
  EXPECT_NEAR(row_scale(logs, kMeasured).kernel_s, 0.048, 0.01);
  logs[0].q.col(0) = logs[0].q.col(1);
  EXPECT_EQ(row_scale(logs, kMeasured).kernel_s, 0.012);
}

}  // namespace
}  // namespace faultline
