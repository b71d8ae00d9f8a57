// SPDX-License-Identifier: MIT
#include "lib/balance/uniform_log.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "lib/log/log_source.hpp"

namespace faultline {
namespace {

constexpr double kPeriod_s = 0.002;

/// One joint at `position(t)`; row `missing` was not recorded.
UniformLog without_row(int missing, double (*position)(double)) {
  Log log;
  log.q.resize(1);
  log.dq.resize(1);
  log.tau.resize(1);
  for (int k = 0; k < 400; ++k) {
    if (k == missing) continue;
    log.time.push_back(k * kPeriod_s);
    log.q[0].push_back(position(k * kPeriod_s));
    log.dq[0].push_back(0.0);
    log.tau[0].push_back(0.0);
  }
  MemorySource source(std::move(log));
  return uniform_log(source, kPeriod_s);
}

TEST(UniformLog, AMissingRowOfASmoothMotionIsInterpolatedByACubic) {
  const UniformLog log = without_row(150, [](double t) { return std::sin(5.0 * t); });
  EXPECT_FALSE(log.lost[150]);
  EXPECT_NEAR(log.q(150, 0), std::sin(5.0 * 150 * kPeriod_s), 1e-8);
}

TEST(UniformLog, AMissingRowBetweenEqualEncoderCodesRepeatsTheCode) {
  const UniformLog log = without_row(150, [](double) { return -1.07282781; });
  for (int k = 1; k < log.rows(); ++k) ASSERT_EQ(log.q(k, 0), log.q(k - 1, 0)) << k;
}

/// A position that runs at 1 rad/s and the torque that it equals, read together.
UniformLog rising(int rows) {
  UniformLog log;
  log.period_s = kPeriod_s;
  log.q.resize(rows, 1);
  for (int k = 0; k < rows; ++k) log.q(k, 0) = k * kPeriod_s;
  log.dq = Eigen::MatrixXd::Ones(rows, 1);
  log.tau = log.q;
  log.lost.assign(rows, false);
  log.q_noise = log.dq_noise = Eigen::VectorXd::Constant(1, 0.3);
  return log;
}

TEST(UniformLog, AMeanHasTheTimeOfTheMiddleOfItsSamples) {
  const UniformLog means = averaged(rising(11), 4, false);
  ASSERT_EQ(means.rows(), 2);
  for (int k = 0; k < 2; ++k) {
    EXPECT_NEAR(means.q(k, 0), means.time_s(k), 1e-15);
    EXPECT_NEAR(means.tau(k, 0), means.time_s(k), 1e-15);
  }
  EXPECT_NEAR(means.period_s, 4 * kPeriod_s, 1e-15);
  EXPECT_NEAR(means.q_noise[0], 0.15, 1e-15);
}

TEST(UniformLog, AHeldTorqueIsAveragedOverTheTimeThatItActs) {
  const UniformLog means = averaged(rising(12), 4, true);
  const double half = 2.0 * kPeriod_s, middle = means.time_s(1);  // it acts from 3.5 to 7.5 periods
  double acts = 0.0;
  for (int i = 0; i < 1000; ++i)
    acts += std::floor((middle - half + 2.0 * half * (i + 0.5) / 1000.0) / kPeriod_s) * kPeriod_s / 1000.0;
  EXPECT_NEAR(means.tau(1, 0), acts, 1e-12);
}

TEST(UniformLog, FirstRowReturnsTheRowAtOrAfterATime) {
  const UniformLog log = rising(5);
  EXPECT_EQ(log.first_row(-1.0), 0);
  EXPECT_EQ(log.first_row(3 * kPeriod_s), 3);
  EXPECT_EQ(log.first_row(2.2 * kPeriod_s), 3);
  EXPECT_EQ(log.first_row(4.5 * kPeriod_s), 5);
}

TEST(UniformLog, AMeanIsLostIfAnyOfItsSamplesIsLost) {
  UniformLog log = rising(12);
  log.lost[6] = true;
  EXPECT_EQ(averaged(std::move(log), 4, false).lost, (std::vector<bool>{false, true, false}));
}

}  // namespace
}  // namespace faultline
