// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <vector>

#include "lib/classify/episode_features.hpp"
#include "lib/diagnose/decide_episode.hpp"
#include "tests/support/hand_made_motion.hpp"

namespace faultline {

inline constexpr FaultLabel kLocked2{FaultKind::locked, 2_joint}, kStuck2{FaultKind::stuck_encoder, 2_joint},
    kBias3{FaultKind::sensor_bias, 3_joint}, kDrift1{FaultKind::sensor_drift, 1_joint},
    kPush1{FaultKind::collision, 1_joint}, kLoss1{FaultKind::torque_loss, 1_joint},
    kFree1{FaultKind::free_swinging, 1_joint}, kUnknown{FaultKind::unknown, Joint()};

/// Two networks that give the same opinion whatever they are shown.
inline EpisodeClassifier classifier_that_says(const Opinion& mlp, const Opinion& rbfn, int features) {
  EpisodeClassifier classifier;
  classifier.labels = {mlp.label};
  if (rbfn.label != mlp.label) classifier.labels.push_back(rbfn.label);
  classifier.labels.push_back({FaultKind::none, Joint()});
  const auto count = static_cast<Eigen::Index>(classifier.labels.size());
  const auto shares = [&](Eigen::Index who, double confidence) {
    Eigen::VectorXd p = Eigen::VectorXd::Constant(count, (1.0 - confidence) / static_cast<double>(count - 1));
    p[who] = confidence;
    return p;
  };
  classifier.scaler = {Eigen::VectorXd::Zero(features), Eigen::VectorXd::Ones(features)};
  classifier.mlp.output = OutputKind::softmax;
  classifier.mlp.layers = {{Eigen::MatrixXd::Zero(count, features), shares(0, mlp.confidence).array().log()}};
  classifier.rbfn.centres = Eigen::MatrixXd::Zero(features, 1);
  classifier.rbfn.inverse_radii = Eigen::MatrixXd::Ones(features, 1);
  classifier.rbfn.weights = Eigen::MatrixXd::Zero(count, 1);
  classifier.rbfn.bias = shares(rbfn.label == mlp.label ? 0 : 1, rbfn.confidence);
  return classifier;
}

/// An RRP robot with its labels, no classifier yet.
inline Model hand_made_rrp() {
  Model model;
  model.robot = known_rrp();
  model.motion = hand_made_motion(model.robot);
  model.labels = fault_labels(3, {3_joint}, false);
  return model;
}

inline std::vector<std::string> features_of(const Model& model) {
  return episode_feature_names(model.labels, model.robot.joints());
}

/// The same with classifier of a fixed opinion.
inline Model hand_made_rrp(const Opinion& mlp, const Opinion& rbfn) {
  Model model = hand_made_rrp();
  model.episode_classifier = classifier_that_says(mlp, rbfn, static_cast<int>(features_of(model).size()));
  return model;
}

/// The log explained by `label`, too; the best of all comes first.
inline void explain(MonitoredEpisode& episode, const FaultLabel& label, double nats, double size = 0.0,
                    double second_size = 0.0) {
  ExplainedFault& fault = episode.fault;
  LabelScore score{.claim = {label.kind, label.joint, 2.0}, .nats = nats};
  const int sizes = describe(label.kind).size_count;
  if (sizes > 0) score.claim.size = Eigen::Vector2d(size, second_size).head(sizes);
  std::erase_if(fault.scores, [&](const LabelScore& s) { return s.label() == label; });
  fault.scores.push_back(score);
  std::stable_sort(fault.scores.begin(), fault.scores.end(),
                   [](const LabelScore& x, const LabelScore& y) { return x.nats > y.nats; });
  if (fault.scores.front().label() != label) return;
  fault.claim = score.claim;
  fault.evidence = nats;
}

/// The same by a fault that explains the log almost as well as the best.
inline void explain_alike(MonitoredEpisode& episode, const FaultLabel& label, double nats) {
  explain(episode, label, nats);
  episode.fault.could_also_be.push_back(label);
}

/// An episode that `label` explains by `nats` and nothing else explains at all.
inline MonitoredEpisode episode_of_fault(const FaultLabel& label, double nats = 100.0, double size = 0.0,
                                         double second_size = 0.0) {
  MonitoredEpisode episode;
  explain(episode, label, nats, size, second_size);
  episode.fault.alarm_s = 2.1;
  episode.fault.limit = 21.0;
  episode.end_s = 4.0;
  return episode;
}

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Residuals of a joint each by their velocity_rms.
inline std::vector<JointResidual> residuals_of(const std::vector<double>& velocity_rms) {
  std::vector<JointResidual> residuals(velocity_rms.size());
  for (std::size_t j = 0; j < velocity_rms.size(); ++j) {
    residuals[j].joint = Joint::at(static_cast<int>(j));
    residuals[j].velocity_rms = velocity_rms[j];
  }
  return residuals;
}

/// The episode as the case base compares it.
inline Episode seen(MonitoredEpisode episode, const Model& model,
                    const std::vector<JointResidual>& residuals = {}) {
  episode.residuals = residuals;
  return describe_episode(episode, model).episode;
}

/// An empty case base that compares what the model's classifier are shown.
inline CaseBase empty_base(const Model& model) { return CaseBase(features_of(model)); }

/// `count` confirmed cases that look exactly like `episode`.
inline CaseBase base_of(const Model& model, const MonitoredEpisode& episode, const FaultLabel& label,
                        int count) {
  CaseBase base = empty_base(model);
  Case c;
  c.episode = seen(episode, model);
  c.decision = c.label = label;
  c.outcome = CaseOutcome::confirmed;
  c.what_was_done = "changed the brake";
  for (int i = 0; i < count; ++i) base.retain(c);
  return base;
}

inline const Alternative* alternative(const FaultFinding& finding, const FaultLabel& label) {
  for (const Alternative& a : finding.could_also_be)
    if (a.label == label) return &a;
  return nullptr;
}

inline const EvidenceItem* item(const FaultFinding& finding, const std::string& name) {
  for (const EvidenceItem& e : finding.evidence)
    if (e.name == name) return &e;
  return nullptr;
}

}  // namespace faultline
