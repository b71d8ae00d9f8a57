// SPDX-License-Identifier: MIT
#include "lib/learn/learn_samples.hpp"

#include <algorithm>
#include <utility>

#include "lib/fault/fault_catalogue.hpp"

namespace faultline {
namespace {

constexpr int kSampleRuns = 6;  // of a label, two thirds for training

CriterionOptions tuned(const CriterionOptions& start, const SampleClassifier& classifier,
                       const std::vector<LabelledResiduals>& runs) {
  const OutputMeaning meaning{classifier.classes, classifier.prior};
  std::vector<LabelledOutputs> outputs;
  for (const LabelledResiduals& run : runs) {
    const SampleOutputs out = classify_samples(classifier, run.residuals);
    outputs.push_back({out.time, out.average(), run.fault, run.onset_s});
  }
  return tune_criterion(start, meaning, outputs).best;
}

/// The runs that single samples are judged by.
std::vector<LabelledResiduals> of_samples(std::vector<LabelledResiduals> runs) {
  std::vector<LabelledResiduals> out;
  std::vector<FaultLabel> taken;
  for (LabelledResiduals& run : runs) {
    const bool is_healthy = run.fault.kind == FaultKind::none;
    if (!is_healthy && (!describe(run.fault.kind).shows_in_each_sample ||
                        std::ranges::count(taken, run.fault) == kSampleRuns))
      continue;
    if (!is_healthy) taken.push_back(run.fault);
    out.push_back(std::move(run));
  }
  return out;
}

}  // namespace

SampleMode learn_sample_mode(const Model& model, std::vector<LabelledResiduals> runs) {
  runs = of_samples(std::move(runs));
  std::vector<LabelledResiduals> training, tuning;
  for (std::size_t i = 0; i < runs.size(); ++i)
    (i % 3 == 2 ? tuning : training).push_back(std::move(runs[i]));
  SampleMode mode;
  mode.classifier = train_sample_classifier(training, model.residual).classifier;
  mode.consecutive = tuned(mode.consecutive, mode.classifier, tuning);
  mode.log_odds = tuned(mode.log_odds, mode.classifier, tuning);
  return mode;
}

}  // namespace faultline
