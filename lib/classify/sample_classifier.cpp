// SPDX-License-Identifier: MIT
#include "lib/classify/sample_classifier.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "lib/core/elementary/elementary.hpp"
#include "lib/core/error.hpp"
#include "lib/core/json/json_matrix.hpp"
#include "lib/core/random.hpp"

namespace faultline {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using nlohmann::json;

MatrixXd features_of(SampleFeatures kind, const VectorXd& torque_rms, const Residuals& residuals) {
  if (kind == SampleFeatures::velocity) return residuals.velocity;
  const Index n = torque_rms.size();
  const auto compressed = [&](const MatrixXd& torque) {
    return ((torque.array().colwise() / torque_rms.array()).unaryExpr(&elementary::asinh)).matrix().eval();
  };
  MatrixXd features(3 * n, residuals.count());
  if (kind == SampleFeatures::hypotheses) {
    features << compressed(residuals.torque.cwiseAbs()),
        compressed((residuals.torque + residuals.tau).cwiseAbs()), compressed(residuals.tau.cwiseAbs());
    return features;
  }
  features << compressed(residuals.torque), compressed(residuals.tau.cwiseAbs()),
      residuals.ratio.unaryExpr([](double ratio) { return std::clamp(ratio, -2.0, 2.0); });
  return features;
}

int feature_count(SampleFeatures kind, int joints) {
  return kind == SampleFeatures::velocity ? joints : 3 * joints;
}

FaultLabel label_at(const LabelledResiduals& run, int i) {
  const double time = run.residuals.time[i];
  return time > run.onset_s && time <= run.end_s ? run.fault : FaultLabel{};
}

bool comes_before(const FaultLabel& a, const FaultLabel& b) {
  return std::pair(a.kind == FaultKind::none, std::pair(a.kind, a.joint)) <
         std::pair(b.kind == FaultKind::none, std::pair(b.kind, b.joint));
}

struct Place {
  int run = 0;
  int sample = 0;
};

/// Samples of each class, from the runs that train and from those that validate.
struct Samples {
  std::map<FaultLabel, std::vector<Place>, decltype(&comes_before)> training{&comes_before},
      validation{&comes_before};
};

Samples sort_samples(std::span<const LabelledResiduals> runs, int validate_every) {
  Samples samples;
  std::map<FaultLabel, int, decltype(&comes_before)> seen(&comes_before);
  for (int r = 0; r < static_cast<int>(runs.size()); ++r) {
    const bool validates = ++seen[runs[r].fault] % std::max(validate_every, 1) == 0 && validate_every > 0;
    auto& side = validates ? samples.validation : samples.training;
    for (int i = 0; i < runs[r].residuals.count(); ++i)
      if (runs[r].residuals.velocity.col(i).allFinite() && runs[r].residuals.torque.col(i).allFinite())
        side[label_at(runs[r], i)].push_back({r, i});
  }
  return samples;
}

/// Returns at most `most` of the places, drawn at random, in their order.
std::vector<Place> draw(const std::vector<Place>& places, int most, Random& random) {
  std::vector<Place> drawn;
  std::size_t needed = std::min<std::size_t>(most, places.size());
  for (std::size_t i = 0; i < places.size() && needed > 0; ++i)
    if (random.below(places.size() - i) < needed) {
      drawn.push_back(places[i]);
      --needed;
    }
  return drawn;
}

template <typename Side>
Patterns assemble(const Side& side, std::span<const MatrixXd> features,
                  const std::vector<FaultLabel>& classes, int most, std::uint64_t seed) {
  Random random(seed);
  std::vector<std::pair<Place, int>> chosen;
  for (const auto& [label, places] : side) {
    const auto output = std::find(classes.begin(), classes.end(), label);
    if (output == classes.end()) continue;
    for (const Place& place : draw(places, most, random))
      chosen.emplace_back(place, static_cast<int>(output - classes.begin()));
  }
  Patterns patterns{MatrixXd(features[0].rows(), chosen.size()),
                    MatrixXd::Zero(classes.size(), chosen.size())};
  for (std::size_t n = 0; n < chosen.size(); ++n) {
    patterns.inputs.col(n) = features[chosen[n].first.run].col(chosen[n].first.sample);
    patterns.targets(chosen[n].second, n) = 1.0;
  }
  return patterns;
}

std::vector<FaultLabel> classes_of(const Samples& samples) {
  std::vector<FaultLabel> classes;
  for (const auto& [label, places] : samples.training) classes.push_back(label);
  if (classes.size() < 2 || classes.back().kind != FaultKind::none)
    throw Error(ErrorCode::input, "labelled runs",
                "need samples both with a fault and without one to train the classifiers on");
  return classes;
}

SampleFeatures features_from(const std::string& name, const std::string& where) {
  for (const auto kind : {SampleFeatures::velocity, SampleFeatures::torque_space, SampleFeatures::hypotheses})
    if (name == to_string(kind)) return kind;
  throw Error(ErrorCode::input, where,
              "features: '" + name + "' is none of velocity, torque_space, hypotheses");
}

Mlp train_mlp(const Patterns& training, const Patterns& validation, const SampleClassifierOptions& options,
              const Progress& progress) {
  const int inputs = static_cast<int>(training.inputs.rows()),
            outputs = static_cast<int>(training.targets.rows());
  Mlp start = make_mlp({inputs, options.hidden, outputs}, options.output, options.seed);
  const auto train =
      options.trainer == SampleTrainer::back_propagation ? train_back_propagation : train_quasi_newton;
  return train(
      std::move(start), training, validation,
      {.max_iterations = options.max_iterations, .weight_decay = options.weight_decay, .seed = options.seed},
      progress);
}

std::vector<FaultLabel> classes_from_json(const json& in, const std::string& where) {
  if (!in.is_array() || in.empty()) throw Error(ErrorCode::input, where, "expected a list of faults");
  std::vector<FaultLabel> classes;
  for (const json& entry : in) {
    const std::string name = text_from_json(entry, "fault", where);
    try {
      classes.push_back({fault_kind_from(name),
                         Joint::numbered(static_cast<int>(number_from_json(entry, "joint", where)))});
    } catch (const Error& error) {
      throw Error(ErrorCode::input, where, error.message());
    }
  }
  return classes;
}

}  // namespace

const char* to_string(SampleFeatures features) {
  return features == SampleFeatures::velocity       ? "velocity"
         : features == SampleFeatures::torque_space ? "torque_space"
                                                    : "hypotheses";
}

SampleOutputs classify_samples(const SampleClassifier& classifier, const Residuals& residuals) {
  if (residuals.count() > 0 && residuals.joints() != classifier.joints())
    throw Error(ErrorCode::input, "residuals",
                fmt::format("of {} joints, but the classifier was trained on {}", residuals.joints(),
                            classifier.joints()));
  const Index classes = static_cast<Index>(classifier.classes.size());
  if (residuals.count() == 0) return {VectorXd(0), MatrixXd(classes, 0), MatrixXd(classes, 0)};
  const MatrixXd scaled =
      classifier.scaler.apply(features_of(classifier.features, classifier.torque_rms, residuals));
  return {residuals.time, forward(classifier.mlp, scaled), forward(classifier.rbfn, scaled)};
}

SampleClassifier train_sample_classifier(std::span<const LabelledResiduals> runs,
                                         const ResidualGenerator& generator,
                                         const SampleClassifierOptions& options, const Progress& progress) {
  const Samples samples = sort_samples(runs, options.validate_every);
  SampleClassifier classifier;
  classifier.features = options.features;
  classifier.classes = classes_of(samples);
  classifier.torque_rms = generator.healthy.torque_rms;
  std::vector<MatrixXd> features;
  for (const LabelledResiduals& run : runs)
    features.push_back(features_of(options.features, classifier.torque_rms, run.residuals));
  Patterns training =
      assemble(samples.training, features, classifier.classes, options.patterns_per_class, options.seed);
  Patterns validation = assemble(samples.validation, features, classifier.classes, options.patterns_per_class,
                                 options.seed + 1);
  classifier.prior = training.targets.rowwise().mean();
  classifier.scaler = standard_scaler(training.inputs);
  training.inputs = classifier.scaler.apply(training.inputs);
  validation.inputs = classifier.scaler.apply(validation.inputs);

  classifier.mlp = train_mlp(training, validation, options, progress);
  classifier.rbfn = train_rbfn(training, options.map);
  return classifier;
}

void to_json(json& out, const SampleClassifier& classifier) {
  json classes = json::array();
  for (const FaultLabel& label : classifier.classes)
    classes.push_back({{"fault", to_string(label.kind)}, {"joint", label.joint.number()}});
  out = {{"features", to_string(classifier.features)},
         {"classes", std::move(classes)},
         {"prior", vector_to_json(classifier.prior)},
         {"torque_rms", vector_to_json(classifier.torque_rms)},
         {"scaler", classifier.scaler},
         {"mlp", classifier.mlp},
         {"rbfn", classifier.rbfn}};
}

SampleClassifier sample_classifier_from_json(const json& in, const std::string& where) {
  SampleClassifier classifier;
  classifier.features = features_from(text_from_json(in, "features", where), where);
  classifier.classes = classes_from_json(member_of(in, "classes", where), where + ", classes");
  classifier.prior = vector_from_json(in, "prior", where);
  classifier.torque_rms = vector_from_json(in, "torque_rms", where);
  classifier.scaler = scaler_from_json(member_of(in, "scaler", where), where + ", scaler");
  classifier.mlp = mlp_from_json(member_of(in, "mlp", where), where + ", mlp");
  classifier.rbfn = rbfn_from_json(member_of(in, "rbfn", where), where + ", rbfn");
  const int inputs = feature_count(classifier.features, classifier.joints());
  const int outputs = static_cast<int>(classifier.classes.size());
  if (classifier.scaler.size() != inputs || classifier.mlp.inputs() != inputs ||
      classifier.rbfn.inputs() != inputs || classifier.mlp.outputs() != outputs ||
      classifier.rbfn.outputs() != outputs || classifier.prior.size() != outputs)
    throw Error(ErrorCode::input, where,
                fmt::format("the networks do not match {} features and {} classes", inputs, outputs));
  return classifier;
}

}  // namespace faultline
