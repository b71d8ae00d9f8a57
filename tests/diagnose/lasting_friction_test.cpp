// SPDX-License-Identifier: MIT
#include "lib/diagnose/lasting_friction.hpp"

#include <gtest/gtest.h>

namespace faultline {
namespace {

TEST(LastingFriction, IsFrictionWhoseWholeIntervalIsBeyondTwiceTheNormalRange) {
  const auto friction = [](double value, double std) {
    return lasting_friction({{DayEffectKind::friction, 2, value, std, 0.1}}, 0.0, 9.0).size();
  };
  EXPECT_EQ(friction(0.5, 0.01), 1u) << "the normal range is 20 %";
  EXPECT_EQ(friction(0.5, 0.2), 0u) << "the log hardly tells it";
  EXPECT_EQ(friction(0.35, 0.01), 0u);
  EXPECT_EQ(friction(-0.9, 0.01), 0u) << "less friction is no fault";
}

TEST(LastingFriction, OtherEffectsTakeOverFromEachOtherAndAreNone) {
  EXPECT_TRUE(lasting_friction({{DayEffectKind::torque_gain, 1, 5.0, 0.01, 0.1}}, 0.0, 9.0).empty());
}

}  // namespace
}  // namespace faultline
