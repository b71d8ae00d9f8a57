// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <vector>

#include "lib/cases/case.hpp"

namespace faultline {

/// One dimension in which episodes are compared.
struct Feature {
  std::string name;
  double scale = 1.0;   ///< a difference of this size is common between cases of the same fault; > 0
  double weight = 1.0;  ///< how well the feature distinguishes faults, 0 to 1

  bool operator==(const Feature&) const = default;
};

/// Similarity of two episodes. The distance d is the weighted root mean square of the scaled differences,
/// each at most `kLargestDifference`; the similarity is 1 / (1 + d): 1 for equal episodes, commonly 0.5 for
/// two cases of the same fault.
struct Metric {
  std::vector<Feature> features;
  double near_similarity = 0.3;  ///< a case with less similarity is no precedent
};

inline constexpr double kLargestDifference = 10.0;  ///< in scales, so that one outlier does not decide

/// Returns 0 to 1. Ignores features that are NaN on either side; 0 if the remaining features have less than
/// half of the weight, or if the lengths are not those of the metric.
double similarity(const Metric& metric, std::span<const double> a, std::span<const double> b);

/// Computes scales and weights from cases of known fault: the scale is the spread within a fault, the weight
/// the share of the variance between faults (Fisher's correlation ratio). near_similarity is the 2 % quantile
/// of the similarity of each case to the nearest other case of its fault. With fewer than two faults of two
/// cases each, `features` keeps its scales and weights.
Metric learn_metric(std::vector<Feature> features, std::span<const Case> cases);

}  // namespace faultline
