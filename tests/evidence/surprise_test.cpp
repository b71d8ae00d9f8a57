// SPDX-License-Identifier: MIT
#include "lib/evidence/surprise.hpp"

#include <gtest/gtest.h>

#include "lib/core/random.hpp"

namespace faultline {
namespace {

/// Innovations of one joint's position, each `memory` times the one before and fresh noise, of that size.
Surprise surprise_of(int rows, double memory, double size, std::uint64_t seed = 1) {
  Random random(seed);
  Surprise surprise;
  double w = 0.0;
  for (int k = 0; k < rows; ++k) {
    w = memory * w + std::sqrt(1.0 - memory * memory) * random.normal();
    surprise.add(0, size * w, 0.0, false);
  }
  return surprise;
}

TEST(Surprise, WhiteNoiseHasAMeanSquareOfOneAndNoMemory) {
  const Surprise white = surprise_of(20000, 0.0, 1.0);
  EXPECT_NEAR(white.mean_square(), 1.0, 0.03);
  EXPECT_NEAR(white.correlation(), 0.0, 0.02);
  EXPECT_EQ(white.numbers(), 20000.0);
  EXPECT_NEAR(surprise_of(20000, 0.4, 1.0).correlation(), 0.4, 0.03);
}

TEST(Surprise, JointsAndVelocitiesHaveMemoriesOfTheirOwn) {
  Surprise surprise;
  for (int k = 0; k < 100; ++k) surprise.add(k % 2, k % 2 ? 1.0 : -1.0, k % 2 ? -1.0 : 1.0, true);
  EXPECT_NEAR(surprise.correlation(), 0.98, 0.021) << "each repeats itself";
}

TEST(Surprise, WhiteNoiseIsNotFarFromWhiteWhateverTheSeed) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed)
    EXPECT_FALSE(is_far_from_white(surprise_of(400, 0.0, 1.0, seed), {})) << seed;
}

TEST(Surprise, WhatIsLargeOrRepeatsIsFarFromWhite) {
  EXPECT_TRUE(is_far_from_white(surprise_of(1500, 0.0, 1.3), {}));
  EXPECT_TRUE(is_far_from_white(surprise_of(1500, 0.4, 1.0), {}));
}

TEST(Surprise, AFaultThatIsSpecificMayLeaveALittle) {
  EXPECT_TRUE(is_far_from_white(surprise_of(1500, 0.25, 1.0), {}, false));
  EXPECT_FALSE(is_far_from_white(surprise_of(1500, 0.25, 1.0), {}, true));
  EXPECT_TRUE(is_far_from_white(surprise_of(1500, 0.5, 1.0), {}, true));
  EXPECT_TRUE(is_far_from_white(surprise_of(1500, 0.0, 1.5), {}, true));
}

TEST(Surprise, WhatIsUsualIsNoEvidence) {
  EXPECT_FALSE(is_far_from_white(surprise_of(1500, 0.4, 1.3, 2), surprise_of(500, 0.4, 1.3, 3)));
}

TEST(Surprise, FewRowsOrAWildValueTellNothing) {
  EXPECT_FALSE(is_far_from_white(surprise_of(30, 0.9, 3.0), {}));
  Surprise wild = surprise_of(1500, 0.0, 1.0);
  for (int k = 0; k < 5; ++k) wild.add(0, 1e6, 0.0, false), wild.add(0, 0.0, 0.0, false);
  EXPECT_FALSE(is_far_from_white(wild, {}));
  EXPECT_FALSE(is_far_from_white({}, {}));
}

}  // namespace
}  // namespace faultline
