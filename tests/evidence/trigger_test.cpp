// SPDX-License-Identifier: MIT
#include "lib/evidence/trigger.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lib/core/random.hpp"

namespace faultline {
namespace {

/// A model of one joint, as far as the trigger looks at it.
MotionModel one_joint(int longest_repeat) {
  MotionModel model;
  model.chain = preset_robot("P").chain;
  model.longest_repeat = {longest_repeat};
  return model;
}

FollowedSample sample_of(double whitened_q, double whitened_dq, bool repeats = false) {
  FollowedSample sample;
  sample.dt = 0.01;
  sample.whitened.fill(0.0);
  sample.whitened[0] = whitened_q;
  sample.whitened[1] = whitened_dq;
  sample.repeats.fill(repeats);
  return sample;
}

TEST(Trigger, OnWhiteNoiseItIsTheLargestOfTenUnitNormals) {
  const MotionModel model = one_joint(0);
  Trigger trigger(model);
  Random random(8);
  const int rows = 40000;
  double sum = 0.0, largest = 0.0;
  for (int k = 0; k < rows; ++k) {
    const double statistic = trigger.take(sample_of(random.normal(), random.normal()));
    sum += statistic;
    largest = std::max(largest, statistic);
  }
  EXPECT_NEAR(sum / rows, 1.7, 0.25) << "the mean of the largest of ten, partly correlated, |N(0,1)|";
  EXPECT_LT(largest, 5.5);
  EXPECT_GT(largest, 3.5);
}

TEST(Trigger, AConstantOffsetGrowsWithTheRootOfTheWindow) {
  const MotionModel model = one_joint(0);
  Trigger trigger(model);
  double statistic = 0.0;
  for (int k = 0; k < 300; ++k) statistic = trigger.take(sample_of(0.5, 0.0));
  EXPECT_NEAR(statistic, 0.5 * 16.0, 1e-9);
}

TEST(Trigger, ANewStartForgets) {
  const MotionModel model = one_joint(0);
  Trigger trigger(model);
  for (int k = 0; k < 300; ++k) trigger.take(sample_of(1.0, 1.0));
  FollowedSample anew = sample_of(0.0, 0.0);
  anew.dt = 0.0;
  EXPECT_EQ(trigger.take(anew), 0.0);
  EXPECT_NEAR(trigger.take(sample_of(0.25, 0.0)), 0.25, 1e-12);
}

TEST(Trigger, RepeatedCodesCountWhereTheyMeanSomething) {
  const MotionModel noisy = one_joint(0), coarse = one_joint(40);
  Trigger watched(noisy), ignored(coarse);
  for (int k = 0; k < 5; ++k) {
    watched.take(sample_of(0.0, 0.0, true));
    ignored.take(sample_of(0.0, 0.0, true));
  }
  EXPECT_EQ(watched.repeated_codes(), 5);
  EXPECT_EQ(ignored.repeated_codes(), 0);
  watched.take(sample_of(0.0, 0.0, false));
  EXPECT_EQ(watched.repeated_codes(), 0);
}

}  // namespace
}  // namespace faultline
