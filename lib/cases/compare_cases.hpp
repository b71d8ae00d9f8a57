// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "lib/cases/case_base.hpp"

namespace faultline {

/// One feature of two episodes.
struct FeatureMatch {
  std::size_t feature = 0;  ///< its place in the metric
  double difference = 0.0;  ///< in scales: below 1 as cases of the same fault commonly have it
  double telling = 0.0;     ///< ranks what a person should see first
};

/// Why two episodes are as similar as they are, each list with what tells most first.
struct Likeness {
  std::vector<FeatureMatch> alike;   ///< within a scale, and both unlike what is usual in the base
  std::vector<FeatureMatch> unlike;  ///< further apart than that, by their share of the distance
};

/// A feature over all cases of a base; NaN where fewer than two have it.
struct UsualFeature {
  double mean = 0.0;
  double spread = 0.0;  ///< standard deviation
};
std::vector<UsualFeature> usual_features(const CaseBase& base);

/// Features that are missing on either side, or tell no faults apart (weight below 0.1), are left out.
Likeness compare_cases(const Metric& metric, std::span<const UsualFeature> usual, std::span<const double> a,
                       std::span<const double> b);

}  // namespace faultline
