// SPDX-License-Identifier: MIT
#include "lib/simulate/motion.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lib/core/error.hpp"

namespace faultline {
namespace {

constexpr double kDuration = 12.0;

Motion make(MotionProfile profile, std::uint64_t seed = 1) {
  MotionSpec spec;
  spec.profile = profile;
  return Motion(preset_robot("RRP"), spec, kDuration, seed);
}

/// dq and ddq against differences of q and dq, away from the corners of a trapezoid.
void expect_derivatives(const Motion& motion, double tolerance) {
  Reference before, now, after;
  const double h = 1e-5;
  int wrong = 0, checked = 0;
  for (double t = 0.01; t < kDuration; t += 0.0317) {
    motion.at(t - h, before);
    motion.at(t, now);
    motion.at(t + h, after);
    ++checked;
    const double error = ((after.q - before.q) / (2 * h) - now.dq).norm() +
                         ((after.dq - before.dq) / (2 * h) - now.ddq).norm();
    wrong += error > tolerance;
  }
  EXPECT_GT(checked, 300);
  EXPECT_EQ(wrong, 0);
}

TEST(Motion, DerivativesMatchDifferences) {
  expect_derivatives(make(MotionProfile::quintic), 1e-3);
  expect_derivatives(make(MotionProfile::fourier), 1e-3);
  expect_derivatives(make(MotionProfile::trapezoidal), 1e-3);
}

TEST(Motion, StaysInItsRanges) {
  for (const auto profile :
       {MotionProfile::quintic, MotionProfile::trapezoidal, MotionProfile::step, MotionProfile::fourier}) {
    const Motion motion = make(profile, 7);
    Reference at;
    double moved = 0.0, last = 0.0;
    for (double t = 0.0; t < kDuration; t += 0.01) {
      motion.at(t, at);
      EXPECT_LE(std::abs(at.q[0]), 2.0 + 0.01);
      EXPECT_LE(std::abs(at.q[1]), 2.0 + 0.01);
      EXPECT_GE(at.q[2], -0.35 - 0.001);
      EXPECT_LE(at.q[2], 0.05 + 0.001);
      if (t > 0.0) moved += std::abs(at.q[0] - last);
      last = at.q[0];
    }
    EXPECT_GT(moved, 3.0);
  }
}

TEST(Motion, StartsAtRest) {
  for (const auto profile : {MotionProfile::quintic, MotionProfile::fourier}) {
    Reference at;
    make(profile).at(0.0, at);
    EXPECT_LT(at.dq.norm(), 1e-9);
  }
}

TEST(Motion, VisitsTheGivenPointsInTurn) {
  MotionSpec spec;
  spec.points = {{0.0, 0.0, 0.0}, {1.0, -1.0, -0.1}};
  spec.move_min_s = spec.move_max_s = 1.0;
  spec.dwell_min_s = spec.dwell_max_s = 0.5;
  const Motion motion(preset_robot("RRP"), spec, 6.0, 1);
  Reference at;
  motion.at(1.7, at);
  EXPECT_EQ(at.q[1], -1.0);
  motion.at(3.2, at);
  EXPECT_EQ(at.q[1], 0.0);
}

TEST(Motion, ReplayPassesThroughItsSamples) {
  MotionSpec spec;
  spec.profile = MotionProfile::replay;
  spec.replay.period_s = 0.05;
  spec.replay.q.resize(1);
  spec.replay.dq.resize(1);
  for (int k = 0; k < 100; ++k) {
    spec.replay.q[0].push_back(std::sin(0.05 * k));
    spec.replay.dq[0].push_back(std::cos(0.05 * k));
  }
  const Motion motion(preset_robot("R"), spec, 4.0, 1);
  Reference at;
  for (double t = 0.0; t < 4.9; t += 0.013) {
    motion.at(t, at);
    EXPECT_NEAR(at.q[0], std::sin(t), 1e-7);
    EXPECT_NEAR(at.dq[0], std::cos(t), 1e-5);
    EXPECT_NEAR(at.ddq[0], -std::sin(t), 2e-3);
  }
  motion.at(99.0, at);
  EXPECT_EQ(at.q[0], spec.replay.q[0].back());
  EXPECT_EQ(at.dq[0], 0.0);
}

TEST(Motion, RefusesInvalidSpecs) {
  MotionSpec spec;
  spec.low = {1.0};
  EXPECT_THROW(Motion(preset_robot("RRP"), spec, 1.0, 1), Error);
  spec = {};
  spec.low = {1.0, 0.0, 0.0};
  spec.high = {0.0, 1.0, 1.0};
  EXPECT_THROW(Motion(preset_robot("RRP"), spec, 1.0, 1), Error);
  spec = {};
  spec.move_min_s = 0.0;
  EXPECT_THROW(Motion(preset_robot("RRP"), spec, 1.0, 1), Error);
  spec = {};
  spec.profile = MotionProfile::replay;
  EXPECT_THROW(Motion(preset_robot("RRP"), spec, 1.0, 1), Error);
}

}  // namespace
}  // namespace faultline
