// SPDX-License-Identifier: MIT
#include "lib/log/difference_velocity.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lib/core/random.hpp"

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

void derive(Log& log, int back, int ahead) {
  for (int k = back; k + ahead < log.rows(); ++k)
    log.dq[0][k] = (log.q[0][k + ahead] - log.q[0][k - back]) / (log.time[k + ahead] - log.time[k - back]);
}

TEST(DifferenceVelocity, AMeasuredVelocityIsNone) {
  EXPECT_EQ(velocities_by_difference(swinging(1e-4)), std::vector<char>{0});
  EXPECT_EQ(velocities_by_difference(swinging(1e-6)), std::vector<char>{0});
}

TEST(DifferenceVelocity, BackwardForwardAndCentralDifferencesAreRecognised) {
  for (const auto& [back, ahead] : {std::pair{1, 0}, {0, 1}, {1, 1}}) {
    Log log = swinging(1e-4);
    derive(log, back, ahead);
    EXPECT_EQ(velocities_by_difference(log), std::vector<char>{1}) << back << ahead;
  }
}

TEST(DifferenceVelocity, RowsLostAfterwardsDoNotHideIt) {
  Log log = swinging(1e-4), kept;
  derive(log, 1, 0);
  for (int k = 0; k < log.rows(); ++k)
    if (k % 20 != 7) append(kept, slice(log, k, k + 1));
  EXPECT_EQ(velocities_by_difference(kept), std::vector<char>{1});
}

TEST(DifferenceVelocity, AJointAtRestAndALogWithoutVelocityTellNothing) {
  Log log = swinging(0.0);
  log.q[0].assign(kRows, 0.4);
  log.dq[0].assign(kRows, 0.0);
  EXPECT_EQ(velocities_by_difference(log), std::vector<char>{0});
  log.dq.clear();
  EXPECT_EQ(velocities_by_difference(log), std::vector<char>{0});
}

}  // namespace
}  // namespace faultline
