// SPDX-License-Identifier: MIT
#include "lib/cases/metric.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/cases/example_base.hpp"

namespace faultline {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

Metric two_features(double weight_a, double weight_b) {
  return {.features = {{"a", 1.0, weight_a}, {"b", 2.0, weight_b}}, .near_similarity = 0.3};
}

TEST(Metric, SimilarityIsOneForEqualCasesAndHalfAtOneScale) {
  const Metric metric = two_features(1.0, 1.0);
  const std::vector<double> a = {1.0, 2.0}, one_scale_away = {2.0, 4.0};
  EXPECT_DOUBLE_EQ(similarity(metric, a, a), 1.0);
  EXPECT_DOUBLE_EQ(similarity(metric, a, one_scale_away), 0.5);
  EXPECT_DOUBLE_EQ(similarity(metric, one_scale_away, a), 0.5);
}

TEST(Metric, AFeatureWithoutWeightDoesNotCount) {
  const std::vector<double> a = {1.0, 2.0}, b = {1.0, 200.0};
  EXPECT_DOUBLE_EQ(similarity(two_features(1.0, 0.0), a, b), 1.0);
  EXPECT_LT(similarity(two_features(1.0, 1.0), a, b), 0.2);
}

TEST(Metric, TheDifferenceOfAFeatureIsCapped) {
  const std::vector<double> a = {1.0, 2.0}, wild = {1.0, 1e200};
  EXPECT_DOUBLE_EQ(similarity(two_features(1.0, 1.0), a, wild),
                   1.0 / (1.0 + kLargestDifference / std::sqrt(2.0)));
}

TEST(Metric, MissingFeaturesAreLeftOutUntilLessThanHalfTheWeightIsLeft) {
  const std::vector<double> a = {1.0, 2.0}, no_b = {1.0, kNaN}, nothing = {kNaN, kNaN};
  EXPECT_DOUBLE_EQ(similarity(two_features(1.0, 1.0), a, no_b), 1.0);
  EXPECT_DOUBLE_EQ(similarity(two_features(0.4, 1.0), a, no_b), 0.0);
  EXPECT_DOUBLE_EQ(similarity(two_features(1.0, 1.0), nothing, nothing), 0.0);
}

TEST(Metric, FeaturesOfDifferentLengthHaveNoSimilarity) {
  const std::vector<double> a = {1.0, 2.0}, shorter = {1.0};
  EXPECT_DOUBLE_EQ(similarity(two_features(1.0, 1.0), a, shorter), 0.0);
}

TEST(Metric, GivesWeightToFeaturesThatDistinguishFaults) {
  const Metric metric = example_base(30).metric();
  EXPECT_GT(metric.features[0].weight, 0.95);
  EXPECT_GT(metric.features[1].weight, 0.95);
  EXPECT_LT(metric.features[2].weight, 0.2);
  EXPECT_NEAR(metric.features[0].scale, 0.1, 0.03);
  EXPECT_GT(metric.near_similarity, 0.1);
  EXPECT_LT(metric.near_similarity, 0.95);
}

TEST(Metric, AConstantFeatureGetsNoWeight) {
  std::vector<Case> cases(6);
  for (int i = 0; i < 6; ++i) {
    cases[i].label = i < 3 ? kFree : kLocked;
    cases[i].episode.features = {i < 3 ? 0.0 : 1.0, 5.0, kNaN};
  }
  const Metric metric = learn_metric({{"steps", 1, 1}, {"constant", 1, 1}, {"missing", 1, 1}}, cases);
  EXPECT_DOUBLE_EQ(metric.features[0].weight, 1.0);
  EXPECT_GT(metric.features[0].scale, 0.0);
  EXPECT_DOUBLE_EQ(metric.features[1].weight, 0.0);
  EXPECT_DOUBLE_EQ(metric.features[2].weight, 0.0);
}

TEST(Metric, TooFewCasesKeepTheMetric) {
  std::vector<Case> cases(3);
  for (Case& c : cases) c.episode.features = {1.0};
  const Metric metric = learn_metric({{"a", 3.0, 0.7}}, cases);
  EXPECT_DOUBLE_EQ(metric.features[0].scale, 3.0);
  EXPECT_DOUBLE_EQ(metric.features[0].weight, 0.7);
}

}  // namespace
}  // namespace faultline
