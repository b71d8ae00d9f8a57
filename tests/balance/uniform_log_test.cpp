// SPDX-License-Identifier: MIT
#include "lib/balance/uniform_log.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lib/log/memory_source.hpp"

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

TEST(UniformLog, AMissingRowOfASmoothMotionIsBridgedByACubic) {
  const UniformLog log = without_row(150, [](double t) { return std::sin(5.0 * t); });
  EXPECT_FALSE(log.lost[150]);
  EXPECT_NEAR(log.q(150, 0), std::sin(5.0 * 150 * kPeriod_s), 1e-8);
}

TEST(UniformLog, AMissingRowOfARepeatedCodeRepeatsIt) {
  const UniformLog log = without_row(150, [](double) { return -1.07282781; });
  for (int k = 1; k < log.rows(); ++k) ASSERT_EQ(log.q(k, 0), log.q(k - 1, 0)) << k;
}

}  // namespace
}  // namespace faultline
