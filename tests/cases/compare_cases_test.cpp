// SPDX-License-Identifier: MIT
#include "lib/cases/compare_cases.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/cases/example_base.hpp"

namespace faultline {
namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

Metric metric_of(const std::vector<double>& weights) {
  Metric metric;
  for (std::size_t i = 0; i < weights.size(); ++i)
    metric.features.push_back({"f" + std::to_string(i), 0.5, weights[i]});
  return metric;
}

std::vector<std::size_t> places(const std::vector<FeatureMatch>& matches) {
  std::vector<std::size_t> out;
  for (const FeatureMatch& match : matches) out.push_back(match.feature);
  return out;
}

TEST(CompareCases, SharedUnusualFeaturesComeFirst) {
  const std::vector<UsualFeature> usual = {{0, 1}, {0, 1}, {0, 1}, {3, 20}};
  const std::vector<double> a = {0.1, 4.0, 1.0, 0.0}, b = {0.1, 4.1, 1.0, 0.0};
  const Likeness found = compare_cases(metric_of({1, 1, 1, 1}), usual, a, b);
  EXPECT_EQ(places(found.alike), (std::vector<std::size_t>{1, 2})) << "the others are as all cases are";
  EXPECT_NEAR(found.alike[0].difference, 0.2, 1e-12);
  EXPECT_TRUE(found.unlike.empty());
}

TEST(CompareCases, DifferingFeaturesAreOrderedByTheirShareOfTheDistance) {
  const std::vector<UsualFeature> usual = {{0, 1}, {0, 1}, {0, 1}};
  const std::vector<double> a = {0, 0, 0}, b = {1.0, 2.0, 2.0};
  const Likeness found = compare_cases(metric_of({1, 0.5, 0.9}), usual, a, b);
  EXPECT_EQ(places(found.unlike), (std::vector<std::size_t>{2, 1, 0}));
  EXPECT_NEAR(found.unlike[0].difference, 4.0, 1e-12);
}

TEST(CompareCases, FeaturesOfLittleWeightOrWithoutValueAreLeftOut) {
  const std::vector<UsualFeature> usual = {{0, 1}, {0, 1}, {0, 1}, {0, 1}};
  const std::vector<double> a = {5, 5, kMissing, -1.0}, b = {5, 9, 5, 1.0};
  const Likeness found = compare_cases(metric_of({0.05, 0.05, 1, 1}), usual, a, b);
  EXPECT_TRUE(found.alike.empty());
  EXPECT_EQ(places(found.unlike), (std::vector<std::size_t>{3}));
}

TEST(CompareCases, UsualFeaturesHaveMeanAndSpreadOfTheMeasuredValues) {
  CaseBase base({"a", "b"});
  for (const double x : {1.0, 3.0}) {
    Case c;
    c.episode.features = {x, kMissing};
    base.retain(c);
  }
  EXPECT_EQ(usual_features(base)[0].mean, 2.0);
  EXPECT_NEAR(usual_features(base)[0].spread, std::sqrt(2.0), 1e-12);
  EXPECT_TRUE(std::isnan(usual_features(base)[1].mean));
}

}  // namespace
}  // namespace faultline
