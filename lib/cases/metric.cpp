// SPDX-License-Identifier: MIT
#include "lib/cases/metric.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace faultline {
namespace {

struct Moments {
  double count = 0.0, mean = 0.0, squares = 0.0;

  void add(double x) {
    count += 1.0;
    const double step = x - mean;
    mean += step / count;
    squares += step * (x - mean);
  }
};

using LabelKey = std::pair<int, Joint>;
LabelKey key_of(const FaultLabel& label) { return {static_cast<int>(label.kind), label.joint}; }

/// Sums of squares of one feature: within the faults, and about the mean of all cases.
struct ValueSpread {
  double within = 0.0, total = 0.0, count = 0.0, groups = 0.0;
};

ValueSpread spread_of(std::span<const Case> cases, std::size_t feature) {
  std::map<LabelKey, Moments> groups;
  Moments all;
  for (const Case& c : cases) {
    const double x = c.episode.features[feature];
    if (!std::isfinite(x)) continue;
    groups[key_of(c.label)].add(x);
    all.add(x);
  }
  ValueSpread spread;
  for (const auto& [label, moments] : groups) spread.within += moments.squares;
  spread.total = all.squares;
  spread.count = all.count;
  spread.groups = static_cast<double>(groups.size());
  return spread;
}

void learn_feature(Feature& feature, const ValueSpread& spread) {
  if (spread.count <= spread.groups || !(spread.total > 0.0)) {
    feature.weight = 0.0;  // constant over all cases, or never twice in one fault: distinguishes nothing
    return;
  }
  const double within = spread.within / (spread.count - spread.groups);
  const double total = spread.total / (spread.count - 1.0);
  feature.weight = std::clamp(1.0 - spread.within / spread.total, 0.0, 1.0);
  feature.scale = std::sqrt(std::max(within, 1e-4 * total));  // bounded if it is constant within each fault
}

bool enough_to_learn(std::span<const Case> cases) {
  std::map<LabelKey, int> counts;
  for (const Case& c : cases) ++counts[key_of(c.label)];
  return std::count_if(counts.begin(), counts.end(), [](const auto& entry) { return entry.second >= 2; }) >=
         2;
}

/// Returns the similarity to the nearest other case of its fault, for each case that has one.
std::vector<double> similarity_to_own(const Metric& metric, std::span<const Case> cases) {
  std::vector<double> nearest;
  for (const Case& a : cases) {
    double best = -1.0;
    for (const Case& b : cases)
      if (&a != &b && a.label == b.label)
        best = std::max(best, similarity(metric, a.episode.features, b.episode.features));
    if (best >= 0.0) nearest.push_back(best);
  }
  return nearest;
}

}  // namespace

double similarity(const Metric& metric, std::span<const double> a, std::span<const double> b) {
  if (a.size() != metric.features.size() || b.size() != a.size()) return 0.0;
  double all = 0.0, shared = 0.0, sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Feature& feature = metric.features[i];
    all += feature.weight;
    const double difference = std::min(std::abs(a[i] - b[i]) / feature.scale, kLargestDifference);
    if (!(std::isfinite(a[i]) && std::isfinite(b[i]))) continue;
    shared += feature.weight;
    sum += feature.weight * difference * difference;
  }
  if (!(shared > 0.0) || shared < 0.5 * all) return 0.0;
  return 1.0 / (1.0 + std::sqrt(sum / shared));
}

Metric learn_metric(std::vector<Feature> features, std::span<const Case> cases) {
  Metric metric;
  metric.features = std::move(features);
  if (!enough_to_learn(cases)) return metric;
  for (std::size_t i = 0; i < metric.features.size(); ++i)
    learn_feature(metric.features[i], spread_of(cases, i));
  std::vector<double> nearest = similarity_to_own(metric, cases);
  const auto lonely = nearest.begin() + static_cast<std::ptrdiff_t>(nearest.size() / 50);
  std::nth_element(nearest.begin(), lonely, nearest.end());
  metric.near_similarity = *lonely;
  return metric;
}

}  // namespace faultline
