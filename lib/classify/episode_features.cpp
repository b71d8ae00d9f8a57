// SPDX-License-Identifier: MIT
#include "lib/classify/episode_features.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/core/elementary/elementary.hpp"
#include "lib/fault/fault_catalogue.hpp"
#include "lib/fault/fault_kind.hpp"

namespace faultline {
namespace {

constexpr double kSizeFades = 20.0;  // nats; a label's size is weighted by exp(-deficit / this)
constexpr double kNotJudged = -1e3;  // nats of a label without a judged hypothesis
constexpr double kShortest_s = 1e-3, kLongest_s = 3.0;  // durations are bounded to this range

// Conversions between numbers and features: deficit of evidence to the most likely label in nats, and the
// weight of the size of a label with that deficit.
constexpr double kLargestDeficit = 300.0;  // nats; a label with more is excluded anyway

double deficit_of_feature(double feature) { return elementary::exp(-feature) - 1.0; }

double size_counts(double deficit_nats) {
  return elementary::exp(-std::min(deficit_nats, kLargestDeficit) / kSizeFades);
}

/// Returns the size bounded to -1..1; 0 for a hypothesis that diverged.
double bounded_size(double size) { return std::isfinite(size) ? elementary::tanh(size) : 0.0; }

constexpr double kHardlyCounts = 0.5;  // weight of a size below which it is not shown
constexpr double kLargestTanh = 0.9999;
constexpr double kRounding = 1e-6;

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
  if (behind == list.end()) return std::nan("");
  const double counts = size_counts(deficit_of_feature(features[behind - list.begin()]));
  if (!(counts > kHardlyCounts)) return std::nan("");
  const double tanh = std::clamp(features[which] / counts, -kLargestTanh, kLargestTanh);
  return 0.5 * elementary::log1p(2.0 * tanh / (1.0 - tanh));  // inverse of tanh
}

DescribedFeature read_size(std::span<const EpisodeFeature> list, std::size_t which,
                           std::span<const double> features, const UsualMotion& usual, const Chain& chain) {
  const FaultLabel& label = list[which].label;
  const int j = label.joint.index(), s = list[which].size;
  DescribedFeature reading{"size of " + quoted(label), ""};
  if (j < 0 || j >= usual.joints() || s >= describe(label.kind).size_count) return reading;
  const FaultSize& size = describe(label.kind).size[s];
  const bool turns = chain.geometry[j].kind == AxisKind::revolute;
  const bool is_share = size.feature == SizeMeasure::torque_share;
  reading.unit = is_share ? "%" : unit_of(size.feature, turns);
  reading.value =
      unfaded_size(list, which, features) * feature_scale(usual, size.feature, j) * (is_share ? 100.0 : 1.0);
  return reading;
}

}  // namespace

std::array<double, kMostSizes> sizes_of(const FaultClaim& claim, double end_s, int joints) {
  std::array<double, kMostSizes> out{};
  if (claim.kind == FaultKind::collision) {
    out[0] = impulse_of(claim, claim.joint.index(), joints);
    return out;
  }
  const double lasts_s = std::min(claim.end_s, end_s) - claim.onset_s;
  for (int s = 0; s < std::min<int>(kMostSizes, static_cast<int>(claim.size.size())); ++s)
    out[s] = claim.size[s] * (claim.grows ? lasts_s : 1.0);
  return out;
}

double impulse_of(const FaultClaim& claim, int j, int joints) {
  double mean = 0.0;
  for (Eigen::Index form = 0; (form + 1) * joints <= claim.size.size(); ++form)
    mean += kMeanOfForceForm[static_cast<std::size_t>(form)] * claim.size[form * joints + j];
  return mean == 0.0 ? 0.0 : mean * (claim.end_s - claim.onset_s);
}

std::vector<LabelEvidence> evidence_by_label(const ExplainedFault& fault, double end_s,
                                             std::span<const FaultLabel> labels, const UsualMotion& usual) {
  std::vector<LabelEvidence> out;
  for (const FaultLabel& label : labels) {
    LabelEvidence& entry = out.emplace_back(LabelEvidence{label, kNotJudged});
    const auto score = std::find_if(fault.scores.begin(), fault.scores.end(),
                                    [&](const LabelScore& s) { return s.label() == label; });
    if (score == fault.scores.end()) continue;
    entry.log_likelihood_ratio = std::max(kNotJudged, score->nats);
    entry.left = score->left;
    const std::array<double, kMostSizes> sizes = sizes_of(score->claim, end_s, usual.joints());
    const std::span<const FaultSize> described = describe(label.kind).sizes();
    for (std::size_t s = 0; s < described.size(); ++s)
      entry.size[s] = sizes[s] / feature_scale(usual, described[s].feature, label.joint.index());
  }
  return out;
}

double posterior_of(const FaultLabel& label, const std::vector<LabelEvidence>& evidence) {
  double best = 0.0, sum = 0.0, of_label = 0.0;
  for (const LabelEvidence& e : evidence) best = std::max(best, e.log_likelihood_ratio);
  for (const LabelEvidence& e : evidence) {
    const double weight = elementary::exp(e.log_likelihood_ratio - best);
    sum += weight;
    if (e.label == label) of_label += weight;
  }
  return sum > 0.0 ? of_label / sum : 0.0;
}

std::vector<double> episode_features(const std::vector<LabelEvidence>& evidence, double lasts_s,
                                     std::span<const JointResidual> residuals, int joints) {
  double best = 0.0;
  for (const LabelEvidence& e : evidence) best = std::max(best, e.log_likelihood_ratio);
  std::vector<double> features;
  for (const LabelEvidence& e : evidence)
    features.push_back(-elementary::log1p(std::min(best - e.log_likelihood_ratio, kLargestDeficit)));
  for (const LabelEvidence& e : evidence) {
    const double counts = size_counts(best - e.log_likelihood_ratio);
    features.push_back(counts * bounded_size(e.size[0]));
    for (int s = 1; s < describe(e.label.kind).size_count; ++s)
      features.push_back(counts * bounded_size(e.size[s]));
  }
  features.push_back(elementary::log1p(best));
  features.push_back(elementary::log(std::clamp(lasts_s, kShortest_s, kLongest_s)));
  for (int j = 0; j < joints; ++j) {
    const bool is_known = j < std::ssize(residuals) && std::isfinite(residuals[j].velocity_rms);
    features.push_back(is_known ? elementary::log(std::max(residuals[j].velocity_rms, 1e-3)) : 0.0);
  }
  return features;
}

std::vector<EpisodeFeature> episode_feature_list(std::span<const FaultLabel> labels, int joints) {
  std::vector<EpisodeFeature> list;
  for (const FaultLabel& label : labels) list.push_back({FeatureRole::behind, label});
  for (const FaultLabel& label : labels)
    for (int s = 0; s < std::max(describe(label.kind).size_count, 1); ++s)
      list.push_back({FeatureRole::size, label, s});
  for (const FeatureRole role : {FeatureRole::strength, FeatureRole::duration})
    list.push_back({.role = role});
  for (int j = 0; j < joints; ++j) list.push_back({.role = FeatureRole::residual, .joint = Joint::at(j)});
  return list;
}

std::string name_of(const EpisodeFeature& feature) {
  switch (feature.role) {
    case FeatureRole::behind:
      return "behind " + label_text(feature.label);
    case FeatureRole::size:
      return (feature.size == 0 ? "size"
                                : std::string(describe(feature.label.kind).size[feature.size].feature_name)) +
             " " + label_text(feature.label);
    case FeatureRole::strength:
      return "strength";
    case FeatureRole::duration:
      return "duration";
    case FeatureRole::residual:
      return fmt::format("mlp residual {}", feature.joint);
  }
  return "";
}

std::vector<std::string> episode_feature_names(std::span<const FaultLabel> labels, int joints) {
  std::vector<std::string> names;
  for (const EpisodeFeature& feature : episode_feature_list(labels, joints))
    names.push_back(name_of(feature));
  return names;
}

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
      return {fmt::format("MLP residual of joint {}", list[which].joint), "times healthy",
              elementary::exp(x)};
  }
  return {};
}

}  // namespace faultline
