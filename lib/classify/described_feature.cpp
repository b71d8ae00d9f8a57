// SPDX-License-Identifier: MIT
#include "lib/classify/described_feature.hpp"

#include <algorithm>
#include <cmath>

#include "lib/core/elementary/elementary.hpp"
#include "lib/fault/fault_words.hpp"

namespace faultline {
namespace {

constexpr double kHardlyCounts = 0.5;  // weight of a size below which it is not shown
constexpr double kLargestTanh = 0.9999;
constexpr double kRounding = 1e-6;
constexpr double kPercent = 100.0;
constexpr double kNotTold = std::numeric_limits<double>::quiet_NaN();

/// Returns the deficit in nats, without rounding error at its bound kLargestDeficit.
double nats_behind(double feature) {
  const double nats = deficit_of_feature(feature);
  return nats > kLargestDeficit - kRounding ? kLargestDeficit : nats;
}

std::string quoted(const FaultLabel& label) { return "\"" + plain_words(label) + "\""; }

/// Returns the size divided by its feature_scale(), without the weight and the bound of the feature.
double unfaded_size(std::span<const EpisodeFeature> list, std::size_t which,
                    std::span<const double> features) {
  const auto behind = std::find_if(list.begin(), list.end(), [&](const EpisodeFeature& f) {
    return f.role == FeatureRole::behind && f.label == list[which].label;
  });
  if (behind == list.end()) return kNotTold;
  const double counts = size_counts(deficit_of_feature(features[behind - list.begin()]));
  if (!(counts > kHardlyCounts)) return kNotTold;
  const double tanh = std::clamp(features[which] / counts, -kLargestTanh, kLargestTanh);
  return 0.5 * elementary::log1p(2.0 * tanh / (1.0 - tanh));  // inverse of tanh
}

DescribedFeature read_size(std::span<const EpisodeFeature> list, std::size_t which,
                           std::span<const double> features, const UsualMotion& usual, const Chain& chain) {
  const FaultLabel& label = list[which].label;
  const int j = label.joint - 1, s = list[which].size;
  DescribedFeature reading{"size of " + quoted(label), "", kNotTold};
  if (j < 0 || j >= usual.joints() || s >= describe(label.kind).size_count) return reading;
  const FaultSize& size = describe(label.kind).size[s];
  const bool turns = chain.geometry[j].kind == AxisKind::revolute;
  const bool is_share = size.feature == SizeMeasure::torque_share;
  reading.unit = is_share ? "%" : unit_of(size.feature, turns);
  reading.value = unfaded_size(list, which, features) * feature_scale(usual, size.feature, j) *
                  (is_share ? kPercent : 1.0);
  return reading;
}

}  // namespace

DescribedFeature describe_feature(std::span<const EpisodeFeature> list, std::size_t which,
                                  std::span<const double> features, const UsualMotion& usual,
                                  const Chain& chain) {
  const double x = features[which];
  switch (list[which].role) {
    case FeatureRole::behind:
      return {quoted(list[which].label) + " behind the best explanation", "nats", nats_behind(x)};
    case FeatureRole::size:
      return read_size(list, which, features, usual, chain);
    case FeatureRole::strength:
      return {"log-likelihood ratio of the fault to a healthy robot", "nats", elementary::exp(x) - 1.0};
    case FeatureRole::duration:
      return {"time from onset to end", "s", elementary::exp(x)};
    case FeatureRole::residual:
      return {"MLP residual of joint " + std::to_string(list[which].joint), "times healthy",
              elementary::exp(x)};
  }
  return {};
}

}  // namespace faultline
