// SPDX-License-Identifier: MIT
#include "lib/evidence/watch/slow_watch.hpp"

#include <gtest/gtest.h>

#include "lib/robot/robot.hpp"

namespace faultline {
namespace {

constexpr double kRange = 0.3;

/// A robot of three joints whose friction may be 30 % off, and the drive of joint 1 by 2 %.
MotionModel model() {
  MotionModel model;
  model.chain = preset_robot("RRP").chain;
  for (int j = 0; j < 3; ++j) model.slow.push_back({SlowKind::friction, j, kRange / kStdsInRange, 0.0, 0.0});
  model.slow.push_back({SlowKind::torque_gain, 0, 0.01, 0.0, 0.0});
  return model;
}

/// A filter's state with that friction of joint 2 and that gain of joint 1, each with its doubt.
GaussianState state(double friction_2, double gain_1, double std) {
  GaussianState state;
  state.size = 10;
  state.mean.fill(0.0);
  state.covariance.fill(0.0);
  state.mean[7] = friction_2;
  state.mean[9] = gain_1;
  for (int i = 0; i < state.size; ++i) state.p(i, i) = std * std;
  return state;
}

TEST(SlowWatch, FrictionThatCreepsAwayIsAFaultWithAnIntervalOfItsOnset) {
  SlowWatch watch(model());
  for (int k = 0; k <= 1000; ++k) watch.take(state(0.1 * 0.1 * k, 0.0, 0.01), 0.1 * k);  // 10 % a second
  ASSERT_EQ(watch.faults().size(), 1u);
  const SlowFault& fault = watch.faults().front();
  EXPECT_EQ(fault.estimate.state.joint, 1);
  EXPECT_NEAR(fault.left_s, 3.2, 0.11);  // .3 and its doubt
  EXPECT_NEAR(fault.from_s, 0.2, 0.11) << "more than identified from there on";
  EXPECT_NEAR(fault.alarm_s, 11.2, 0.21);  // twice that, for five seconds
  EXPECT_EQ(fault.end_s, 100.0);
  EXPECT_NEAR(fault.estimate.value, 10.0, 1e-9);
}

TEST(SlowWatch, WhatIsDoubtfulOrWithinTwiceTheNormalRangeIsNone) {
  SlowWatch watch(model());
  for (int k = 0; k <= 1000; ++k) watch.take(state(0.6, 0.0, 0.01), 0.1 * k);
  for (int k = 0; k <= 1000; ++k) watch.take(state(1.0, 0.0, 0.3), 0.1 * k);
  EXPECT_TRUE(watch.faults().empty());
}

TEST(SlowWatch, WhatPassesWithinSecondsIsNone) {
  SlowWatch watch(model());
  for (int k = 0; k <= 1000; ++k) watch.take(state(k % 100 < 45 ? 2.0 : 0.0, 0.0, 0.01), 0.1 * k);
  EXPECT_TRUE(watch.faults().empty());
}

TEST(SlowWatch, FrictionThatReturnsEndsTheFaultAndMayBeginAnother) {
  SlowWatch watch(model());
  for (int k = 0; k <= 1000; ++k) watch.take(state(k % 500 < 250 ? 1.0 : 0.0, 0.0, 0.01), 0.1 * k);
  ASSERT_EQ(watch.faults().size(), 2u);
  EXPECT_NEAR(watch.faults()[0].end_s, 24.9, 1e-9);
  EXPECT_NEAR(watch.faults()[1].left_s, 50.0, 1e-9);
}

TEST(SlowWatch, OtherStatesAndLessFrictionAreNone) {
  SlowWatch watch(model());
  for (int k = 0; k <= 1000; ++k) watch.take(state(-0.9, 0.5, 0.001), 0.1 * k);
  EXPECT_TRUE(watch.faults().empty());
}

}  // namespace
}  // namespace faultline
