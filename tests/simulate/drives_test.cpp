// SPDX-License-Identifier: MIT
#include "lib/simulate/drives.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lib/core/error.hpp"
#include "lib/simulate/simulate.hpp"
#include "tests/simulate/short_runs.hpp"

namespace faultline {
namespace {

TEST(Drives, GiveTheCommandByDefault) {
  Drives drives(2, {}, Random(1));
  JointVector torque(2);
  torque << 3.0, -4.0;
  drives.act(0.001, torque);
  EXPECT_EQ(torque[0], 3.0);
  EXPECT_EQ(torque[1], -4.0);
}

TEST(Drives, GainAndOffsetAddToTheCommand) {
  Drives drives(2, {.gain = {0.1, 0.0}, .offset = {0.0, 0.5}}, Random(1));
  JointVector torque(2);
  torque << 3.0, -4.0;
  drives.act(0.001, torque);
  EXPECT_DOUBLE_EQ(torque[0], 3.3);
  EXPECT_DOUBLE_EQ(torque[1], -3.5);
}

TEST(Drives, GiveAtMostTheirLimit) {
  Drives drives(2, {.gain = {0.1, 0.0}, .limit = {3.1, 5.0}}, Random(1));
  JointVector torque(2);
  torque << 3.0, -4.0;
  drives.act(0.001, torque);
  EXPECT_EQ(torque[0], 3.1);
  EXPECT_EQ(torque[1], -4.0);
  torque << -3.0, -7.0;
  drives.act(0.001, torque);
  EXPECT_EQ(torque[0], -3.1);
  EXPECT_EQ(torque[1], -5.0);
}

/// Mean square of the roughness over steps of that length, and its product from step to step.
std::pair<double, double> moments(double length_s, double memory_s) {
  Drives drives(1, {.roughness = {2.0}, .roughness_memory_s = {memory_s}}, Random(7));
  double square = 0.0, product = 0.0, last = 0.0;
  constexpr int kCount = 200000;
  for (int k = 0; k < kCount; ++k) {
    JointVector torque = JointVector::Zero(1);
    drives.act(length_s, torque);
    square += torque[0] * torque[0] / kCount;
    product += torque[0] * last / kCount;
    last = torque[0];
  }
  return {square, product};
}

TEST(Drives, RoughnessHasItsLevelAndItsMemory) {
  const auto [square, product] = moments(0.001, 0.03);
  EXPECT_NEAR(square, 4.0, 0.25);
  EXPECT_NEAR(product / square, std::exp(-0.001 / 0.03), 0.002);
}

TEST(Drives, LongStepsGetTheMeanOfTheRoughness) {
  const double x = 0.073 / 0.03;  // the mean of the process over x memories
  const double share = 2.0 / x * (1.0 - (1.0 - std::exp(-x)) / x);
  EXPECT_NEAR(moments(0.073, 0.03).first, 4.0 * share, 0.25 * 4.0 * share);
}

TEST(Drives, TheLogHoldsTheCommandAndNotTheActualTorque) {
  SimulationSpec spec = short_run(1.0);
  const Log plain = simulate(industrial(), spec, 3).log;
  spec.drives.offset = {5.0, 0.0, 0.0};
  const Log offset = simulate(industrial(), spec, 3).log;
  EXPECT_EQ(plain.tau[0][0], offset.tau[0][0]);
  EXPECT_NE(plain.q[0][200], offset.q[0][200]);
}

TEST(Drives, AGainThatReversesTheTorqueIsRefused) {
  SimulationSpec spec = short_run(1.0);
  spec.drives.gain = {-1.5, 0.0, 0.0};
  EXPECT_THROW(simulate(industrial(), spec), Error);
  spec.drives.gain = {0.1};
  EXPECT_THROW(simulate(industrial(), spec), Error);
}

}  // namespace
}  // namespace faultline
