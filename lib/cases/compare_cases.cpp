// SPDX-License-Identifier: MIT
#include "lib/cases/compare_cases.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace faultline {
namespace {

constexpr double kLeastWeight = 0.1;
constexpr double kStandsOut = 0.5;  // least shared_deviation() of a listed feature, standard deviations

/// Returns how much further both are from the mean than from each other, in standard deviations of all cases.
double shared_deviation(double a, double b, const UsualFeature& usual) {
  if ((a > usual.mean) != (b > usual.mean) || !(usual.spread > 0.0)) return 0.0;
  const double odd = std::min(std::abs(a - usual.mean), std::abs(b - usual.mean));
  return std::min((odd - std::abs(a - b)) / usual.spread, kLargestDifference);
}

void sort(std::vector<FeatureMatch>& matches) {
  std::stable_sort(matches.begin(), matches.end(),
                   [](const FeatureMatch& a, const FeatureMatch& b) { return a.importance > b.importance; });
}

}  // namespace

std::vector<UsualFeature> usual_features(const CaseBase& base) {
  std::vector<UsualFeature> usual;
  for (std::size_t i = 0; i < base.metric().features.size(); ++i) {
    double count = 0.0, mean = 0.0, squares = 0.0;
    for (const Case& c : base.cases()) {
      const double x = c.episode.features[i];
      if (!std::isfinite(x)) continue;
      const double step = x - mean;
      mean += step / ++count;
      squares += step * (x - mean);
    }
    usual.push_back(count > 1.0 ? UsualFeature{mean, std::sqrt(squares / (count - 1.0))} : UsualFeature{});
  }
  return usual;
}

Likeness compare_cases(const Metric& metric, std::span<const UsualFeature> usual, std::span<const double> a,
                       std::span<const double> b) {
  Likeness found;
  if (a.size() != metric.features.size() || b.size() != a.size() || usual.size() != a.size()) return found;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Feature& feature = metric.features[i];
    if (feature.weight < kLeastWeight || !std::isfinite(a[i]) || !std::isfinite(b[i])) continue;
    const double difference = std::min(std::abs(a[i] - b[i]) / feature.scale, kLargestDifference);
    if (difference > 1.0)
      found.unlike.push_back({i, difference, feature.weight * difference * difference});
    else if (const double odd = shared_deviation(a[i], b[i], usual[i]); odd > kStandsOut)
      found.alike.push_back({i, difference, feature.weight * odd});
  }
  sort(found.alike);
  sort(found.unlike);
  return found;
}

}  // namespace faultline
