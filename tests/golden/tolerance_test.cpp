// SPDX-License-Identifier: MIT
#include "lib/golden/tolerance.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace faultline {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(GoldenTolerance, IsAbsolutePlusRelative) {
  const Tolerance t{0.1, 0.01};
  EXPECT_TRUE(t.agree(10.0, 10.199));
  EXPECT_FALSE(t.agree(10.0, 10.201));
  EXPECT_TRUE(t.agree(-10.0, -9.801));
  EXPECT_FALSE(Tolerance{}.agree(1.0, std::nextafter(1.0, 2.0)));
}

TEST(GoldenTolerance, NanEqualsNanOnly) {
  const Tolerance wide{1e9, 1e9};
  EXPECT_TRUE(wide.agree(kNan, kNan));
  EXPECT_FALSE(wide.agree(kNan, 0.0));
  EXPECT_FALSE(wide.agree(0.0, kNan));
  EXPECT_TRUE(wide.agree(INFINITY, INFINITY));
  EXPECT_FALSE(wide.agree(INFINITY, -INFINITY));
  EXPECT_FALSE(wide.agree(INFINITY, 1.0));
}

TEST(GoldenTolerance, TheNearestTableDecidesAndTheChannelGoesBeforeItsFamily) {
  Tolerances log, all;
  all.by_channel = {{"dq2", {0.2, 0}}, {"dq", {0.1, 0}}, {"q", {0.3, 0}}};
  log.by_channel = {{"dq", {0.5, 0}}};
  EXPECT_EQ(tolerance_of({&all}, "dq2", "dq").absolute, 0.2);
  EXPECT_EQ(tolerance_of({&all}, "dq1", "dq").absolute, 0.1);
  EXPECT_EQ(tolerance_of({&log, &all}, "dq2", "dq").absolute, 0.5);
  EXPECT_EQ(tolerance_of({&log, &all}, "q2", "q").absolute, 0.3);
  EXPECT_EQ(tolerance_of({}, "q2", "q").absolute, 0.0);
}

TEST(GoldenTolerance, TheNearestTableThatSetsItDecidesOnTheLength) {
  Tolerances silent, strict, loose;
  strict.length_may_differ = false;
  loose.length_may_differ = true;
  EXPECT_FALSE(length_may_differ({}));
  EXPECT_TRUE(length_may_differ({&silent, &loose}));
  EXPECT_FALSE(length_may_differ({&strict, &loose}));
}

TEST(GoldenTolerance, AChannelOfAJointBelongsToItsFamily) {
  for (const std::string& family : tolerance_families()) EXPECT_EQ(tolerance_family(family), family);
  EXPECT_EQ(tolerance_family("q1"), "q");
  EXPECT_EQ(tolerance_family("dq12"), "dq");
  EXPECT_EQ(tolerance_family("velocity_rms_2"), "velocity_rms");
  for (const char* none : {"", "qx", "q1x", "q_1", "velocity_rms2", "velocity_rms_", "m1", "onset"})
    EXPECT_EQ(tolerance_family(none), "") << none;
}

}  // namespace
}  // namespace faultline
