// SPDX-License-Identifier: MIT
#include "lib/classify/episode_classifier.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "lib/core/error.hpp"
#include "lib/neural/training.hpp"

namespace faultline {
namespace {

std::vector<FaultLabel> labels_in(std::span<const LabelledEpisode> episodes) {
  std::vector<FaultLabel> labels;
  for (const LabelledEpisode& episode : episodes)
    if (std::find(labels.begin(), labels.end(), episode.label) == labels.end())
      labels.push_back(episode.label);
  std::sort(labels.begin(), labels.end(), [](const FaultLabel& a, const FaultLabel& b) {
    return a.kind != b.kind ? a.kind < b.kind : a.joint < b.joint;
  });
  return labels;
}

Patterns patterns_of(std::span<const LabelledEpisode> episodes, const std::vector<FaultLabel>& labels) {
  Patterns patterns;
  const auto count = static_cast<Eigen::Index>(episodes.size());
  patterns.inputs.resize(static_cast<Eigen::Index>(episodes.front().features.size()), count);
  patterns.targets.setZero(static_cast<Eigen::Index>(labels.size()), count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const LabelledEpisode& episode = episodes[static_cast<std::size_t>(i)];
    patterns.inputs.col(i) =
        Eigen::Map<const Eigen::VectorXd>(episode.features.data(), patterns.inputs.rows());
    patterns.targets(std::find(labels.begin(), labels.end(), episode.label) - labels.begin(), i) = 1.0;
  }
  return patterns;
}

Opinion opinion(const std::vector<FaultLabel>& labels, const Eigen::VectorXd& outputs) {
  Eigen::Index largest = 0;
  outputs.maxCoeff(&largest);
  const double all = outputs.cwiseMax(0.0).sum();
  return {labels[static_cast<std::size_t>(largest)], all > 0.0 ? std::max(outputs[largest], 0.0) / all : 0.0};
}

}  // namespace

EpisodeClassifier train_episode_classifier(std::span<const LabelledEpisode> episodes,
                                           const EpisodeClassifierOptions& options) {
  EpisodeClassifier classifier;
  classifier.labels = labels_in(episodes);
  if (classifier.labels.size() < 2)
    throw Error(ErrorCode::input, "training the networks",
                "the episodes show " + std::to_string(classifier.labels.size()) +
                    " kinds of fault; at least two are needed to distinguish them");
  Patterns patterns = patterns_of(episodes, classifier.labels);
  classifier.scaler = standard_scaler(patterns.inputs);
  patterns.inputs = classifier.scaler.apply(patterns.inputs);
  const int inputs = static_cast<int>(patterns.inputs.rows()),
            outputs = static_cast<int>(classifier.labels.size());
  const PatternSplit split = split_patterns(patterns, options.validation_share, options.seed);
  classifier.mlp =
      train_quasi_newton(make_mlp({inputs, options.hidden, outputs}, OutputKind::softmax, options.seed),
                         split.training, split.validation, {.weight_decay = options.weight_decay});
  classifier.rbfn =
      train_rbfn(patterns, {.rows = options.map_side, .columns = options.map_side, .seed = options.seed});
  return classifier;
}

Opinions classify_episode(const EpisodeClassifier& classifier, const std::vector<double>& features) {
  const Eigen::MatrixXd inputs = classifier.scaler.apply(
      Eigen::Map<const Eigen::VectorXd>(features.data(), static_cast<Eigen::Index>(features.size())));
  return {opinion(classifier.labels, forward(classifier.mlp, inputs).col(0)),
          opinion(classifier.labels, forward(classifier.rbfn, inputs).col(0))};
}

void to_json(nlohmann::json& json, const EpisodeClassifier& classifier) {
  nlohmann::json labels = nlohmann::json::array();
  for (const FaultLabel& label : classifier.labels)
    labels.push_back({to_string(label.kind), label.joint.number()});
  json = {
      {"labels", labels}, {"scaler", classifier.scaler}, {"mlp", classifier.mlp}, {"rbfn", classifier.rbfn}};
}

EpisodeClassifier episode_classifier_from_json(const nlohmann::json& json, const std::string& where) {
  EpisodeClassifier classifier;
  try {
    for (const auto& label : json.at("labels"))
      classifier.labels.push_back(
          {fault_kind_from(label.at(0).get<std::string>()), Joint::numbered(label.at(1).get<int>())});
    classifier.scaler = scaler_from_json(json.at("scaler"), where);
    classifier.mlp = mlp_from_json(json.at("mlp"), where);
    classifier.rbfn = rbfn_from_json(json.at("rbfn"), where);
  } catch (const nlohmann::json::exception& error) {
    throw Error(ErrorCode::input, where,
                std::string("the episode classifier cannot be read (") + error.what() + ")");
  }
  const int outputs = static_cast<int>(classifier.labels.size());
  if (classifier.mlp.outputs() != outputs || classifier.rbfn.outputs() != outputs ||
      classifier.mlp.inputs() != classifier.scaler.size() ||
      classifier.rbfn.inputs() != classifier.scaler.size())
    throw Error(ErrorCode::input, where, "the episode classifier does not match its labels and features");
  return classifier;
}

}  // namespace faultline
