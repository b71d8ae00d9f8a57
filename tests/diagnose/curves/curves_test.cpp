// SPDX-License-Identifier: MIT
#include "lib/diagnose/curves/curves.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace faultline {
namespace {

TEST(EnvelopeBuilder, ExtremesKeepTheirOrderInTime) {
  EnvelopeBuilder builder(3);
  for (const double v : {2.0, 5.0, 1.0, 3.0}) builder.add(0, v);
  for (const double v : {2.0, 1.0, 5.0}) builder.add(1, v);
  builder.add(2, std::nan(""));
  const std::vector<float> values = builder.envelope().values;
  EXPECT_EQ(std::vector<float>(values.begin(), values.begin() + 4), (std::vector<float>{5, 1, 1, 5}));
  EXPECT_TRUE(std::isnan(values[4]) && std::isnan(values[5]));
}

TEST(EnvelopeBuilder, AJitteringClockLeavesNoGapsButMissingValuesAndLongGapsDo) {
  EnvelopeBuilder builder(8);
  builder.add(0, 1.0);
  builder.add(2, 2.0);  // nothing fell into bin 1
  builder.add(3, std::nan(""));
  builder.add(4, 3.0);
  builder.add(7, 4.0);  // nor into 5 and 6
  const std::vector<float> values = builder.envelope().values;
  EXPECT_EQ(values[2], 1.0f);
  EXPECT_EQ(values[3], 1.0f);
  for (const int bin : {3, 5}) EXPECT_TRUE(std::isnan(values[2 * bin])) << bin;
}

TEST(EnvelopeBuilder, TheEnvelopeOfASignalWithoutValuesIsEmpty) {
  EnvelopeBuilder builder(2);
  builder.add(0, std::nan(""));
  EXPECT_TRUE(builder.envelope().values.empty());
}

}  // namespace
}  // namespace faultline
