// SPDX-License-Identifier: MIT
#include "lib/diagnosis/condition.hpp"

#include <gtest/gtest.h>

#include "lib/robot/robot.hpp"

namespace faultline {
namespace {

SlowEstimate estimate(SlowKind kind, int joint, double day_std, double value, double std,
                      double memory_s = 0.0) {
  return {{kind, joint, day_std, 0.0, memory_s}, value, std};
}

TEST(Condition, SharesAreInPercentAndTorquesInTheUnitOfTheJoint) {
  const std::vector<ConditionItem> items = condition_of({estimate(SlowKind::friction, 0, 0.15, 0.12, 0.01),
                                                         estimate(SlowKind::torque_offset, 1, 0.5, -0.2, 0.1),
                                                         estimate(SlowKind::torque_offset, 2, 0.5, 0.3, 0.1),
                                                         estimate(SlowKind::tip_mass, 2, 0.05, 0.02, 0.005)},
                                                        preset_robot("RRP").chain);
  ASSERT_EQ(items.size(), 4u);
  EXPECT_EQ(items[0].name, "friction_1");
  EXPECT_EQ(items[0].what, "friction of joint 1");
  EXPECT_EQ(items[0].unit, "%");
  EXPECT_DOUBLE_EQ(items[0].value, 12.0);
  EXPECT_NEAR(items[0].ci95[0], 12.0 - 1.96, 1e-3);
  EXPECT_DOUBLE_EQ(items[0].normal_range, 30.0);
  EXPECT_EQ(items[1].unit, "N m");
  EXPECT_EQ(items[2].unit, "N");
  EXPECT_EQ(items[3].name, "tip_mass");
  EXPECT_EQ(items[3].joint, 0);
  EXPECT_EQ(items[3].unit, "kg");
}

TEST(Condition, WhatPassesWithinASecondIsNone) {
  EXPECT_TRUE(
      condition_of({estimate(SlowKind::coloured_torque, 0, 1.0, 5.0, 0.1, 0.05)}, preset_robot("RRP").chain)
          .empty());
}

TEST(Condition, BeyondIsTheWholeIntervalOutsideTheNormalRange) {
  const auto items = condition_of(
      {estimate(SlowKind::friction, 0, 0.15, 0.52, 0.01), estimate(SlowKind::friction, 1, 0.15, 0.35, 0.1),
       estimate(SlowKind::torque_gain, 0, 0.01, -0.05, 0.01)},
      preset_robot("RRP").chain);
  EXPECT_TRUE(items[0].is_beyond());
  EXPECT_FALSE(items[1].is_beyond());
  EXPECT_TRUE(items[2].is_beyond());
  EXPECT_EQ(
      beyond_normal(items),
      "friction of joint 1 (+52 %, normal within 30 %), drive torque of joint 1 (-5 %, normal within 2 %)");
  EXPECT_EQ(beyond_normal({items[1]}), "");
}

TEST(Condition, IsToldWhereTheLogSaysMoreThanTheNormalRange) {
  const auto items = condition_of(
      {estimate(SlowKind::friction, 0, 0.15, 0.0, 0.14), estimate(SlowKind::friction, 1, 0.15, 0.0, 0.16)},
      preset_robot("RRP").chain);
  EXPECT_TRUE(items[0].is_told());
  EXPECT_FALSE(items[1].is_told());
}

}  // namespace
}  // namespace faultline
