// SPDX-License-Identifier: MIT
#include "lib/classify/episode_features.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/core/elementary/elementary.hpp"
#include "lib/evidence/size_scale.hpp"
#include "lib/fault/fault_catalogue.hpp"
#include "lib/fault/label_text.hpp"

namespace faultline {
namespace {

constexpr double kNearlyAll = 0.9;     // share of lost torque from which the joint swings freely
constexpr double kUnknownShare = 0.5;  // of the evidence that a known fault must explain
constexpr double kSizeFades = 20.0;    // the size of a label this far behind hardly counts
constexpr double kNotMeasured = std::numeric_limits<double>::quiet_NaN();

/// The labels a hypothesis can stand for: its own, or those of all joints for a push on all of them.
FaultLabel label_of(const Hypothesis& hypothesis, const HypothesisEvidence& evidence,
                    const MotionModel& model) {
  if (!is_everywhere(hypothesis)) return hypothesis.label;
  int strongest = 0;
  double largest = -1.0;
  for (int j = 0; j < model.joints(); ++j) {
    const double push = std::abs(evidence.impulse[j]) / model.torque_scale[j];
    if (push > largest) largest = push, strongest = j;
  }
  return {FaultKind::collision, strongest + 1};
}

void set_size(LabelEvidence& out, const Hypothesis& hypothesis, const HypothesisEvidence& evidence,
              const MotionModel& model) {
  const int j = out.label.joint - 1;
  const std::span<const FaultSize> sizes = describe(hypothesis.label.kind).sizes();
  for (std::size_t s = 0; s < sizes.size(); ++s) {
    const bool passes = sizes[s].feature == SizeMeasure::impulse;
    out.size[s] =
        (passes ? evidence.impulse[j] : evidence.size[s]) / feature_scale(model, sizes[s].feature, j);
  }
}

/// A hypothesis that lost the robot has no size.
double bounded_size(double size) { return std::isfinite(size) ? elementary::tanh(size) : 0.0; }

/// The labels of the bank once each, without the push on all joints.
std::vector<FaultLabel> distinct_labels(std::span<const Hypothesis> bank) {
  std::vector<FaultLabel> labels;
  for (const Hypothesis& hypothesis : bank)
    if (!is_everywhere(hypothesis) && !is_healthy(hypothesis) &&
        std::find(labels.begin(), labels.end(), hypothesis.label) == labels.end())
      labels.push_back(hypothesis.label);
  return labels;
}

}  // namespace

std::vector<LabelEvidence> evidence_by_label(const EpisodeEvidence& episode, std::span<const Hypothesis> bank,
                                             const MotionModel& model) {
  std::vector<LabelEvidence> out;
  for (const FaultLabel& label : distinct_labels(bank))
    out.push_back({label, -std::numeric_limits<double>::infinity()});
  for (std::size_t h = 0; h < bank.size(); ++h) {
    if (is_healthy(bank[h])) continue;
    const HypothesisEvidence& evidence = episode.hypotheses[h];
    const FaultLabel label = label_of(bank[h], evidence, model);
    auto entry =
        std::find_if(out.begin(), out.end(), [&](const LabelEvidence& e) { return e.label == label; });
    if (evidence.log_likelihood_ratio <= entry->log_likelihood_ratio) continue;
    entry->log_likelihood_ratio = evidence.log_likelihood_ratio;
    entry->surprise = evidence.surprise;
    set_size(*entry, bank[h], evidence, model);
  }
  return out;
}

FaultLabel named_by_size(const FaultLabel& label, const std::vector<LabelEvidence>& evidence) {
  if (label.kind != FaultKind::torque_loss) return label;
  for (const LabelEvidence& e : evidence)
    if (e.label == label && e.size[0] > kNearlyAll) return {FaultKind::free_swinging, label.joint};
  return label;
}

LabelEvidence likeliest(const std::vector<LabelEvidence>& evidence) {
  LabelEvidence known, unknown;
  known.log_likelihood_ratio = unknown.log_likelihood_ratio = -std::numeric_limits<double>::infinity();
  for (const LabelEvidence& e : evidence) {
    LabelEvidence& best = e.label.kind == FaultKind::unknown ? unknown : known;
    if (e.log_likelihood_ratio > best.log_likelihood_ratio) best = e;
  }
  if (known.log_likelihood_ratio < kUnknownShare * unknown.log_likelihood_ratio) {
    unknown.label.joint = 0;
    return unknown;
  }
  known.label = named_by_size(known.label, evidence);
  return known;
}

double posterior_of(const FaultLabel& label, const std::vector<LabelEvidence>& evidence) {
  double best = 0.0, sum = 0.0, of_label = 0.0;
  for (const LabelEvidence& e : evidence) best = std::max(best, e.log_likelihood_ratio);
  for (const LabelEvidence& e : evidence) {
    const double weight = elementary::exp(e.log_likelihood_ratio - best);
    sum += weight;
    if (named_by_size(e.label, evidence) == label) of_label += weight;
  }
  return sum > 0.0 ? of_label / sum : 0.0;
}

std::vector<double> episode_features(const EpisodeEvidence& episode,
                                     const std::vector<LabelEvidence>& evidence,
                                     std::span<const JointResidual> residuals, int joints) {
  double best = 0.0;
  for (const LabelEvidence& e : evidence) best = std::max(best, e.log_likelihood_ratio);
  std::vector<double> features;
  for (const LabelEvidence& e : evidence)
    features.push_back(feature_of_deficit(best - e.log_likelihood_ratio));
  for (const LabelEvidence& e : evidence) {
    const double counts = size_counts(best - e.log_likelihood_ratio);
    features.push_back(counts * bounded_size(e.size[0]));
    for (int s = 1; s < describe(e.label.kind).size_count; ++s)
      features.push_back(counts * bounded_size(e.size[s]));
  }
  features.push_back(elementary::log1p(best));
  features.push_back(elementary::log(static_cast<double>(std::max(episode.samples, 1))));
  features.push_back(elementary::log(std::max(episode.isolated_s - episode.onset_s, 1e-3)));
  for (int j = 0; j < joints; ++j) {
    const double rms = j < std::ssize(residuals) ? residuals[j].velocity_rms : kNotMeasured;
    features.push_back(std::isfinite(rms) ? elementary::log(std::max(rms, 1e-3)) : 0.0);
  }
  return features;
}

std::vector<EpisodeFeature> episode_feature_list(std::span<const Hypothesis> bank, int joints) {
  const std::vector<FaultLabel> labels = distinct_labels(bank);
  std::vector<EpisodeFeature> list;
  for (const FaultLabel& label : labels) list.push_back({FeatureRole::behind, label});
  for (const FaultLabel& label : labels)
    for (int s = 0; s < std::max(describe(label.kind).size_count, 1); ++s)
      list.push_back({FeatureRole::size, label, s});
  for (const FeatureRole role : {FeatureRole::strength, FeatureRole::samples, FeatureRole::duration})
    list.push_back({.role = role});
  for (int j = 1; j <= joints; ++j) list.push_back({.role = FeatureRole::residual, .joint = j});
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
    case FeatureRole::samples:
      return "samples";
    case FeatureRole::duration:
      return "duration";
    case FeatureRole::residual:
      return "mlp residual " + std::to_string(feature.joint);
  }
  return "";
}

std::vector<std::string> episode_feature_names(std::span<const Hypothesis> bank, int joints) {
  std::vector<std::string> names;
  for (const EpisodeFeature& feature : episode_feature_list(bank, joints)) names.push_back(name_of(feature));
  return names;
}

double feature_of_deficit(double nats) { return -elementary::log1p(std::min(nats, kLargestDeficit)); }

double deficit_of_feature(double feature) { return elementary::exp(-feature) - 1.0; }

double size_counts(double deficit_nats) {
  return elementary::exp(-std::min(deficit_nats, kLargestDeficit) / kSizeFades);
}

}  // namespace faultline
