// SPDX-License-Identifier: MIT
#include "lib/classify/confidence_calibration.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "lib/core/random.hpp"

namespace faultline {
namespace {

using enum ConfidenceSource;

/// Names that are right with another probability than is said: votes less often, networks more often.
std::vector<JudgedConfidence> misjudged(int count, std::uint64_t seed) {
  Random random(seed);
  std::vector<JudgedConfidence> judged;
  for (int i = 0; i < count; ++i) {
    const ConfidenceSource source = i % 3 == 0 ? votes : networks;
    const double said = random.uniform(0.3, 0.95);
    const double odds = said / (1.0 - said) * (source == votes ? 0.3 : 6.0);
    judged.push_back({source, said, random.uniform() < odds / (1.0 + odds)});
  }
  return judged;
}

TEST(ConfidenceCalibration, WithoutJudgedRunsConfidencesAreUnchanged) {
  const ConfidenceCalibration none = calibrate_confidence({});
  EXPECT_EQ(none.of(votes, 0.7), 0.7);
  EXPECT_EQ(none.of(likelihood, 1.0), 1.0);
  EXPECT_TRUE(std::isnan(calibration_error({})));
}

TEST(ConfidenceCalibration, GivesTheShareInWhichEachSourceIsRight) {
  const ConfidenceCalibration calibration = calibrate_confidence(misjudged(6000, 1));
  EXPECT_NEAR(calibration.of(networks, 0.5), 6.0 / 7.0, 0.03);
  EXPECT_NEAR(calibration.of(votes, 0.5), 0.3 / 1.3, 0.05);
}

TEST(ConfidenceCalibration, HeldOutErrorFallsBelowAThirdOfTheUncalibratedError) {
  const std::vector<JudgedConfidence> judged = misjudged(3000, 2);
  EXPECT_GT(calibration_error(judged), 0.09);
  EXPECT_LT(held_out_calibration_error(judged), 0.33 * calibration_error(judged));
}

TEST(ConfidenceCalibration, FewRunsThatAreAllRightGiveNoCertainty) {
  const std::vector<JudgedConfidence> judged(18, {networks, 0.9, true});
  const double claimed = calibrate_confidence(judged).of(networks, 0.99);
  EXPECT_GT(claimed, 0.9);
  EXPECT_LE(claimed, 0.95);
}

TEST(ConfidenceCalibration, CalibratedConfidenceNeverFallsAsTheRawConfidenceRises) {
  std::vector<JudgedConfidence> judged = misjudged(300, 3);
  for (JudgedConfidence& one : judged) one.right = one.said < 0.6;  // the surer, the falser
  const ConfidenceCalibration calibration = calibrate_confidence(judged);
  EXPECT_GE(calibration.of(networks, 0.9), calibration.of(networks, 0.4));
}

}  // namespace
}  // namespace faultline
