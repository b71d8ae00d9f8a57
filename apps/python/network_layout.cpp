// SPDX-License-Identifier: MIT
#include "apps/python/network_layout.hpp"

#include <fmt/format.h>

#include <numeric>

#include "lib/classify/episode_features.hpp"
#include "lib/core/error.hpp"
#include "lib/fault/fault_kind.hpp"

namespace faultline {
namespace {

using Eigen::MatrixXd;

/// Returns a port with a column per joint, with the unit for revolute or prismatic joints.
NetworkPort of_joints(const Model& model, const std::string& name, const char* turning, const char* sliding,
                      std::string what) {
  NetworkPort port{.name = name, .what = std::move(what)};
  const auto& geometry = model.robot.chain.geometry;
  for (std::size_t j = 0; j < geometry.size(); ++j) {
    port.columns.push_back(name + std::to_string(j + 1));
    port.units.emplace_back(geometry[j].kind == AxisKind::revolute ? turning : sliding);
  }
  return port;
}

NetworkPort of_classes(const std::string& name, const std::vector<FaultLabel>& classes, std::string what) {
  NetworkPort port{.name = name, .what = std::move(what)};
  for (const FaultLabel& label : classes) port.columns.push_back(label_text(label));
  port.units.assign(port.columns.size(), "1");
  return port;
}

NetworkPort both(NetworkPort first, const NetworkPort& second, const std::string& name, std::string what) {
  first.name = name;
  first.what = std::move(what);
  first.columns.insert(first.columns.end(), second.columns.begin(), second.columns.end());
  first.units.insert(first.units.end(), second.units.begin(), second.units.end());
  return first;
}

NetworkLayout residual_layout(const Model& model) {
  const ResidualGenerator& generator = model.residual;
  NetworkLayout layout{.name = "residual_mlp", .what = "One-step prediction of the healthy motion"};
  layout.inputs = {of_joints(model, "q", "rad", "m", "joint positions"),
                   of_joints(model, "dq", "rad/s", "m/s", "joint velocities"),
                   of_joints(model, "tau", "N m", "N", "joint torques or forces at the same row")};
  if (generator.uses_mean_torque)
    layout.inputs.push_back(
        of_joints(model, "mean_tau", "N m", "N", "joint torques or forces, mean over the step"));
  if (generator.kind == ResidualKind::mlp && generator.target == PredictedQuantity::state) {
    layout.output = both(of_joints(model, "q", "rad", "m", ""), of_joints(model, "dq", "rad/s", "m/s", ""),
                         "next_state", "positions and velocities step_s later");
    return layout;
  }
  layout.output =
      both(of_joints(model, "change_q", "rad", "m", ""), of_joints(model, "change_dq", "rad/s", "m/s", ""),
           "change",
           generator.kind == ResidualKind::hybrid
               ? "change of positions and velocities over step_s beyond what the identified robot predicts"
               : "change of positions and velocities over step_s");
  return layout;
}

const char* unit_in_features(FeatureRole role) {
  switch (role) {
    case FeatureRole::behind:
      return "-ln(1 + nats)";
    case FeatureRole::strength:
      return "ln(1 + nats)";
    case FeatureRole::duration:
      return "ln(s)";
    case FeatureRole::residual:
      return "ln(healthy rms)";
    case FeatureRole::size:
      return "1";
  }
  return "1";
}

NetworkLayout evidence_layout(const Model& model, const std::string& name, std::string what,
                              std::string output) {
  NetworkLayout layout{.name = name, .what = std::move(what)};
  NetworkPort features{.name = "features", .what = "evidence of one episode, as the diagnosis collects it"};
  for (const EpisodeFeature& feature : episode_feature_list(model.labels, model.robot.joints())) {
    features.columns.push_back(name_of(feature));
    features.units.emplace_back(unit_in_features(feature.role));
  }
  const int known = static_cast<int>(features.columns.size()), taken = model.episode_classifier.scaler.size();
  if (taken != known)
    throw Error(ErrorCode::input, model.name,
                fmt::format("its evidence classifiers take {} features, but this program collects {}; "
                            "learn the model again",
                            taken, known));
  layout.inputs.push_back(std::move(features));
  layout.output = of_classes("classes", model.episode_classifier.labels, std::move(output));
  return layout;
}

NetworkLayout sample_layout(const Model& model, const std::string& name, std::string what,
                            std::string output) {
  NetworkLayout layout{.name = name, .what = std::move(what)};
  if (model.samples.classifier.features == SampleFeatures::velocity) {
    layout.inputs = {of_joints(model, "velocity_residual", "healthy rms", "healthy rms",
                               "measured minus predicted velocity in units of the healthy rms")};
  } else {
    layout.inputs = {of_joints(model, "torque_residual", "N m", "N",
                               "torque that the velocity residual stands for: M(q) r / dt"),
                     of_joints(model, "torque", "N m", "N", "logged torque, mean over the step")};
  }
  layout.output = of_classes("classes", model.samples.classifier.classes, std::move(output));
  return layout;
}

/// Returns residuals with the data that the sample classifiers use.
Residuals residuals_from(const Model& model, const std::vector<MatrixXd>& inputs) {
  Residuals out;
  out.row.resize(static_cast<std::size_t>(inputs.front().cols()));
  std::iota(out.row.begin(), out.row.end(), 0);
  out.time = Eigen::VectorXd::Zero(inputs.front().cols());
  out.velocity = inputs.front();
  if (model.samples.classifier.features == SampleFeatures::velocity) return out;
  out.torque = inputs[0];
  out.tau = inputs[1];
  out.ratio = ratio_to_torque(out.torque, out.tau, model.residual.healthy.torque_rms);
  return out;
}

Transitions transitions_from(const ResidualGenerator& generator, const std::vector<MatrixXd>& inputs) {
  Transitions out;
  out.q = inputs[0];
  out.dq = inputs[1];
  out.tau = inputs[2];
  if (generator.uses_mean_torque) out.mean_tau = inputs[3];
  out.row.resize(static_cast<std::size_t>(out.q.cols()));
  return out;
}

}  // namespace

std::vector<NetworkLayout> network_layouts(const Model& model) {
  constexpr const char* kProbability = "probability of each class";
  constexpr const char* kNearOne = "near 1 for the right class, near 0 for the others";
  std::vector<NetworkLayout> all;
  if (!model.has_mechanics()) return all;
  if (model.residual.kind != ResidualKind::physics) all.push_back(residual_layout(model));
  if (model.episode_classifier.trained()) {
    all.push_back(
        evidence_layout(model, "evidence_mlp", "Evidence classifier: the MLP on an episode", kProbability));
    all.push_back(
        evidence_layout(model, "evidence_rbfn", "Evidence classifier: the RBFN on an episode", kNearOne));
  }
  const bool softmax = model.samples.classifier.mlp.output == OutputKind::softmax;
  all.push_back(sample_layout(model, "sample_mlp", "Sample classifier: the MLP on one sample",
                              softmax ? kProbability : kNearOne));
  all.push_back(sample_layout(model, "sample_rbfn", "Sample classifier: the RBFN on one sample", kNearOne));
  return all;
}

MatrixXd run_network(const Model& model, const std::string& network, const std::vector<MatrixXd>& inputs) {
  if (network == "residual_mlp")
    return network_outputs(model.residual, transitions_from(model.residual, inputs));
  if (network.starts_with("evidence")) {
    const EpisodeClassifier& classifier = model.episode_classifier;
    const MatrixXd scaled = classifier.scaler.apply(inputs.front());
    return network == "evidence_mlp" ? forward(classifier.mlp, scaled) : forward(classifier.rbfn, scaled);
  }
  const SampleOutputs outputs = classify_samples(model.samples.classifier, residuals_from(model, inputs));
  return network == "sample_mlp" ? outputs.mlp : outputs.rbfn;
}

}  // namespace faultline
