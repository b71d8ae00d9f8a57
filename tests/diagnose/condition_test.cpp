// SPDX-License-Identifier: MIT
#include "lib/diagnose/condition.hpp"

#include <gtest/gtest.h>

#include "lib/robot/robot.hpp"

namespace faultline {
namespace {

DayEffect estimate(DayEffectKind kind, Joint joint, double day_std, double value, double std) {
  return {kind, joint, value, std, day_std};
}

TEST(Condition, SharesAreInPercentAndTorquesInTheUnitOfTheJoint) {
  const std::vector<ConditionItem> items =
      condition_of({estimate(DayEffectKind::friction, 1_joint, 0.15, 0.12, 0.01),
                    estimate(DayEffectKind::torque_offset, 2_joint, 0.5, -0.2, 0.1),
                    estimate(DayEffectKind::torque_offset, 3_joint, 0.5, 0.3, 0.1)},
                   preset_robot("RRP").chain);
  ASSERT_EQ(items.size(), 3u);
  EXPECT_EQ(items[0].name, "friction_1");
  EXPECT_EQ(items[0].what, "friction of joint 1");
  EXPECT_EQ(items[0].unit, "%");
  EXPECT_DOUBLE_EQ(items[0].value, 12.0);
  EXPECT_NEAR(items[0].ci95[0], 12.0 - 1.96, 1e-3);
  EXPECT_DOUBLE_EQ(items[0].normal_range, 30.0);
  EXPECT_EQ(items[1].unit, "N m");
  EXPECT_EQ(items[2].unit, "N");
}

TEST(Condition, AnItemIsBeyondIfItsWholeIntervalIsOutsideTheNormalRange) {
  const auto items = condition_of({estimate(DayEffectKind::friction, 1_joint, 0.15, 0.52, 0.01),
                                   estimate(DayEffectKind::friction, 2_joint, 0.15, 0.35, 0.1),
                                   estimate(DayEffectKind::torque_gain, 1_joint, 0.01, -0.05, 0.01)},
                                  preset_robot("RRP").chain);
  EXPECT_TRUE(items[0].is_beyond());
  EXPECT_FALSE(items[1].is_beyond());
  EXPECT_TRUE(items[2].is_beyond());
  EXPECT_EQ(
      beyond_normal(items),
      "friction of joint 1 (+52 %, normal within 30 %), drive torque of joint 1 (-5 %, normal within 2 %)");
  EXPECT_EQ(beyond_normal({items[1]}), "");
}

TEST(Condition, AnItemIsDeterminedIfTheLogNarrowsItsNormalRange) {
  const auto items = condition_of({estimate(DayEffectKind::friction, 1_joint, 0.15, 0.0, 0.14),
                                   estimate(DayEffectKind::friction, 2_joint, 0.15, 0.0, 0.16)},
                                  preset_robot("RRP").chain);
  EXPECT_TRUE(items[0].is_determined());
  EXPECT_FALSE(items[1].is_determined());
}

}  // namespace
}  // namespace faultline
