// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "lib/cases/case_base.hpp"

namespace faultline {

/// One feature of two episodes.
struct FeatureMatch {
  std::size_t feature = 0;  ///< index in the metric
  double difference = 0.0;  ///< in scales; below 1 is common between cases of the same fault
  double importance = 0.0;  ///< for a person, by which the matches are sorted
};

/// The features that make two episodes similar or not, the most important first.
struct Likeness {
  std::vector<FeatureMatch> alike;   ///< within one scale, and both unusual in the base
  std::vector<FeatureMatch> unlike;  ///< further apart than one scale, by their share of the distance
};

/// Statistics of a feature over all cases of a base; NaN if fewer than two have it.
struct UsualFeature {
  double mean = std::numeric_limits<double>::quiet_NaN();
  double spread = mean;  ///< standard deviation
};
std::vector<UsualFeature> usual_features(const CaseBase& base);

/// Ignores features that are missing on either side or do not distinguish faults (weight below 0.1).
Likeness compare_cases(const Metric& metric, std::span<const UsualFeature> usual, std::span<const double> a,
                       std::span<const double> b);

}  // namespace faultline
