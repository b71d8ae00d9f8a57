// SPDX-License-Identifier: MIT
#include "lib/identify/motion/motion_smoother.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lib/core/random.hpp"

namespace faultline {
namespace {

constexpr double kPeriod = 0.004;

double q_at(double t) { return std::sin(2.0 * t) + 0.3 * std::sin(5.0 * t + 1.0); }
double dq_at(double t) { return 2.0 * std::cos(2.0 * t) + 1.5 * std::cos(5.0 * t + 1.0); }

JointMotion measured(double q_std, double dq_std, int rows = 2000) {
  Random random(5);
  JointMotion m;
  m.time.resize(rows);
  m.q.resize(rows);
  if (dq_std > 0.0) m.dq.resize(rows);
  m.q_off.setZero(rows);
  m.dq_off.setZero(m.dq.size());
  for (int k = 0; k < rows; ++k) {
    m.time[k] = k * kPeriod;
    m.q[k] = q_at(m.time[k]) + q_std * random.normal();
    if (dq_std > 0.0) m.dq[k] = dq_at(m.time[k]) + dq_std * random.normal();
  }
  return m;
}

double velocity_rms_error(const JointMotion& m, const SmoothMotion& s) {
  double sum = 0.0;
  for (int k = 50; k + 50 < m.rows(); ++k) sum += std::pow(s.dq[k] - dq_at(m.time[k]), 2);
  return std::sqrt(sum / (m.rows() - 100));
}

TEST(MotionSmoother, NoiseOfPositionAndVelocityIsFoundWithinFifteenPercent) {
  const MotionNoise noise = fit_motion_noise(measured(2e-4, 0.05));
  EXPECT_NEAR(noise.q_std / 2e-4, 1.0, 0.15);
  EXPECT_NEAR(noise.dq_std / 0.05, 1.0, 0.15);
}

TEST(MotionSmoother, VelocityIsManyTimesBetterThanItsMeasurement) {
  const JointMotion m = measured(2e-4, 0.05);
  EXPECT_LT(velocity_rms_error(m, smooth_motion(m, fit_motion_noise(m))), 0.05 / 8.0);
}

TEST(MotionSmoother, VelocityComesFromPositionAloneIfNoneIsMeasured) {
  const JointMotion m = measured(1e-5, 0.0);
  const MotionNoise noise = fit_motion_noise(m);
  EXPECT_EQ(noise.dq_std, 0.0);
  EXPECT_LT(velocity_rms_error(m, smooth_motion(m, noise)), 0.003);
}

TEST(MotionSmoother, WithoutNoiseTheMotionPassesUnchanged) {
  const JointMotion m = measured(0.0, 0.0);
  const SmoothMotion s = smooth_motion(m, fit_motion_noise(m));
  for (int k = 0; k < m.rows(); ++k) EXPECT_NEAR(s.q[k], m.q[k], 1e-6);
}

TEST(MotionSmoother, ValuesOfExcludedRowsHaveNoEffect) {
  JointMotion m = measured(1e-5, 0.0), broken = m;
  for (int k = 100; k < 1900; k += 37)
    for (int i = 0; i < 3; ++i) broken.q[k + i] = 77.0, broken.q_off[k + i] = 1;
  const MotionNoise noise = fit_motion_noise(m);
  EXPECT_LT((smooth_motion(broken, noise).q - smooth_motion(m, noise).q).cwiseAbs().maxCoeff(), 1e-4);
}

}  // namespace
}  // namespace faultline
