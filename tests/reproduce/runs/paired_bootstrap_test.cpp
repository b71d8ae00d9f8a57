// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "lib/core/random.hpp"
#include "lib/reproduce/runs/alarm_score.hpp"

namespace faultline {
namespace {

TEST(PairedBootstrap, GivesTheIntervalOfTheNormalApproximationOnManyRuns) {
  Random random(3);
  std::vector<double> ours, theirs;
  for (int i = 0; i < 400; ++i) {
    const double run = 5.0 * random.normal();  // common to both: the pairing takes it out
    theirs.push_back(run);
    ours.push_back(run + 0.3 + random.normal());
  }
  const PairedDifference difference = paired_difference(ours, theirs);
  const double half = 1.96 / std::sqrt(400.0);
  EXPECT_NEAR(difference.low, difference.value - half, 0.02);
  EXPECT_NEAR(difference.high, difference.value + half, 0.02);
}

TEST(PairedBootstrap, CountsAMissedFaultWithTheGivenDelay) {
  AlarmScore score;
  score.outcomes = {{.detected = true, .right_joint = true, .delay_s = 0.2}, {}};
  EXPECT_EQ(delays_of(score, 6.0), (std::vector<double>{0.2, 6.0}));
  EXPECT_EQ(joints_right(score), (std::vector<double>{1.0, 0.0}));
  EXPECT_EQ(kinds_right(score), (std::vector<double>{0.0, 0.0}));
}

}  // namespace
}  // namespace faultline
