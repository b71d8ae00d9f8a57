// SPDX-License-Identifier: MIT
#include "lib/log/derived_velocity.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lib/core/random.hpp"
#include "lib/log/log.hpp"

namespace faultline {
namespace {

constexpr double kPeriod_s = 0.002;
constexpr int kRows = 2000;

/// One joint that swings, with noise, and a velocity measured by itself.
Log swinging(double q_noise) {
  Log log;
  log.q.resize(1);
  log.dq.resize(1);
  Random random(5);
  for (int k = 0; k < kRows; ++k) {
    const double t = k * kPeriod_s;
    log.time.push_back(t);
    log.q[0].push_back(std::sin(3.0 * t) + q_noise * random.normal());
    log.dq[0].push_back(3.0 * std::cos(3.0 * t) + 0.01 * random.normal());
  }
  return log;
}

bool derived(const Log& log) { return !log.dq.empty() && is_derived(log.time, log.q[0], log.dq[0]); }

void derive(Log& log, int back, int ahead) {
  for (int k = back; k + ahead < log.rows(); ++k)
    log.dq[0][k] = (log.q[0][k + ahead] - log.q[0][k - back]) / (log.time[k + ahead] - log.time[k - back]);
}

TEST(DerivedVelocity, AMeasuredVelocityIsNotADerivedVelocity) {
  EXPECT_FALSE(derived(swinging(1e-4)));
  EXPECT_FALSE(derived(swinging(1e-6)));
}

TEST(DerivedVelocity, BackwardForwardAndCentralDifferencesAreRecognised) {
  for (const auto& [back, ahead] : {std::pair{1, 0}, {0, 1}, {1, 1}}) {
    Log log = swinging(1e-4);
    derive(log, back, ahead);
    EXPECT_TRUE(derived(log)) << back << ahead;
  }
}

TEST(DerivedVelocity, LostRowsDoNotHideADerivedVelocity) {
  Log log = swinging(1e-4), kept;
  derive(log, 1, 0);
  for (int k = 0; k < log.rows(); ++k)
    if (k % 20 != 7) append(kept, slice(log, k, k + 1));
  EXPECT_TRUE(derived(kept));
}

/// Passes the velocity through a first-order low pass.
void filter(Log& log, double time_constant_s) {
  double filtered = log.dq[0][0];
  for (double& v : log.dq[0]) v = filtered += (v - filtered) * kPeriod_s / (time_constant_s + kPeriod_s);
}

TEST(DerivedVelocity, AFilterIsRecognisedByItsDelay) {
  for (const double time_constant_s : {0.004, 0.008, 0.016}) {
    Log log = swinging(1e-4);
    filter(log, time_constant_s);
    const VelocityDelay delay = velocity_delay(log.time, log.q[0], log.dq[0]);
    EXPECT_NEAR(delay.delay_s, time_constant_s, 0.1 * time_constant_s);
    EXPECT_TRUE(delay.matters);
    EXPECT_TRUE(derived(log));
  }
}

TEST(DerivedVelocity, AMeasuredVelocityIsNotLate) {
  const Log log = swinging(1e-4);
  const VelocityDelay delay = velocity_delay(log.time, log.q[0], log.dq[0]);
  EXPECT_NEAR(delay.delay_s, 0.0, 3e-4);
  EXPECT_FALSE(delay.matters);
}

TEST(DerivedVelocity, ADelayWithinTheNoiseDoesNotMatter) {
  Log log = swinging(1e-4);
  filter(log, 0.004);
  Random random(7);
  for (double& v : log.dq[0]) v += 0.1 * random.normal();
  EXPECT_FALSE(derived(log));
}

TEST(DerivedVelocity, AJointAtRestAndALogWithoutVelocityHaveNoDerivedVelocity) {
  Log log = swinging(0.0);
  log.q[0].assign(kRows, 0.4);
  log.dq[0].assign(kRows, 0.0);
  EXPECT_FALSE(derived(log));
  log.dq.clear();
  EXPECT_FALSE(derived(log));
}

}  // namespace
}  // namespace faultline
