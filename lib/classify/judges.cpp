// SPDX-License-Identifier: MIT
#include "lib/classify/judges.hpp"

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

NetworkOpinion opinion(const std::vector<FaultLabel>& labels, const Eigen::VectorXd& outputs) {
  Eigen::Index largest = 0;
  outputs.maxCoeff(&largest);
  const double all = outputs.cwiseMax(0.0).sum();
  return {labels[static_cast<std::size_t>(largest)], all > 0.0 ? std::max(outputs[largest], 0.0) / all : 0.0};
}

}  // namespace

Judges train_judges(std::span<const LabelledEpisode> episodes, const JudgeOptions& options) {
  Judges judges;
  judges.labels = labels_in(episodes);
  if (judges.labels.size() < 2)
    throw Error(ErrorCode::input, "training the judges",
                "the episodes show " + std::to_string(judges.labels.size()) +
                    " kinds of fault; at least two are needed to tell them apart");
  Patterns patterns = patterns_of(episodes, judges.labels);
  judges.scaler = standard_scaler(patterns.inputs);
  patterns.inputs = judges.scaler.apply(patterns.inputs);
  const int inputs = static_cast<int>(patterns.inputs.rows()),
            outputs = static_cast<int>(judges.labels.size());
  const PatternSplit split = split_patterns(patterns, options.validation_share, options.seed);
  QuasiNewtonOptions training;
  training.weight_decay = options.weight_decay;
  judges.mlp =
      train_quasi_newton(make_mlp({inputs, options.hidden, outputs}, OutputKind::softmax, options.seed),
                         split.training, split.validation, training)
          .mlp;
  RbfnOptions radial;
  radial.map.rows = radial.map.columns = options.map_side;
  radial.map.seed = options.seed;
  judges.rbfn = train_rbfn(patterns, radial).rbfn;
  return judges;
}

JudgeOpinions judge(const Judges& judges, const std::vector<double>& features) {
  const Eigen::MatrixXd inputs = judges.scaler.apply(
      Eigen::Map<const Eigen::VectorXd>(features.data(), static_cast<Eigen::Index>(features.size())));
  return {opinion(judges.labels, forward(judges.mlp, inputs).col(0)),
          opinion(judges.labels, forward(judges.rbfn, inputs).col(0))};
}

void to_json(nlohmann::json& json, const Judges& judges) {
  nlohmann::json labels = nlohmann::json::array(), scaler, mlp, rbfn;
  for (const FaultLabel& label : judges.labels) labels.push_back({to_string(label.kind), label.joint});
  to_json(scaler, judges.scaler);
  to_json(mlp, judges.mlp);
  to_json(rbfn, judges.rbfn);
  json = {{"labels", labels}, {"scaler", scaler}, {"mlp", mlp}, {"rbfn", rbfn}};
}

Judges judges_from_json(const nlohmann::json& json, const std::string& where) {
  Judges judges;
  try {
    for (const auto& label : json.at("labels"))
      judges.labels.push_back({fault_kind_from(label.at(0).get<std::string>()), label.at(1).get<int>()});
    judges.scaler = scaler_from_json(json.at("scaler"), where);
    judges.mlp = mlp_from_json(json.at("mlp"), where);
    judges.rbfn = rbfn_from_json(json.at("rbfn"), where);
  } catch (const nlohmann::json::exception& error) {
    throw Error(ErrorCode::input, where, std::string("the judges cannot be read (") + error.what() + ")");
  }
  const int outputs = static_cast<int>(judges.labels.size());
  if (judges.mlp.outputs() != outputs || judges.rbfn.outputs() != outputs ||
      judges.mlp.inputs() != judges.scaler.size() || judges.rbfn.inputs() != judges.scaler.size())
    throw Error(ErrorCode::input, where, "the judges' networks do not fit their labels and features");
  return judges;
}

}  // namespace faultline
