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
  double weight = 1.0;  ///< how much the feature tells faults apart, 0 to 1

  bool operator==(const Feature&) const = default;
};

/// How alike two episodes are. Distance d is the weighted root mean square of the scaled differences, each at
/// most `kLargestDifference`; similarity is 1 / (1 + d): 1 for twins, 0.5 where two cases of the same fault
/// commonly stand.
struct Metric {
  std::vector<Feature> features;
  double near_similarity = 0.3;  ///< below it a case is no precedent
};

inline constexpr double kLargestDifference = 10.0;  ///< in scales, so that one wild number does not decide

/// 0 to 1. Features that are NaN on either side are left out; 0 when less than half of the weight is left, or
/// the lengths are not those of the metric.
double similarity(const Metric& metric, std::span<const double> a, std::span<const double> b);

/// Scales and weights from cases of known fault: the scale is the spread within a fault, the weight the share
/// of the variance that lies between faults (Fisher's correlation ratio), and cases count as near when they
/// are as similar as all but the loneliest 2 % are to the nearest other case of their fault. With fewer than
/// two faults of two cases each there is nothing to learn and `features` keeps its scales and weights.
Metric learn_metric(std::vector<Feature> features, std::span<const Case> cases);

}  // namespace faultline
