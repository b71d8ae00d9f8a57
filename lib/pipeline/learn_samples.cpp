// SPDX-License-Identifier: MIT
#include "lib/pipeline/learn_samples.hpp"

#include "lib/core/parallel.hpp"
#include "lib/residual/residuals.hpp"

namespace faultline {
namespace {

std::vector<LabelledResiduals> twin_residuals(const Twin& twin, const Model& model,
                                              const std::vector<FaultLabel>& labels, std::uint64_t first_seed,
                                              int threads) {
  std::vector<LabelledResiduals> runs(labels.size());
  parallel_for(static_cast<int>(labels.size()), threads, [&](int i) {
    const TwinRun run = twin_run(twin, labels[i], first_seed + static_cast<std::uint64_t>(i));
    ResidualState state;
    runs[i].residuals = compute_residuals(model.residual, run.log, state);
    if (run.label.kind == FaultKind::none) return;
    runs[i].fault = run.label;
    runs[i].onset_s = run.onset_s;
    runs[i].end_s = run.end_s;
  });
  return runs;
}

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

}  // namespace

SampleMode learn_sample_mode(const Twin& twin, const Model& model, const std::vector<FaultLabel>& labels,
                             std::uint64_t first_seed, int threads) {
  std::vector<LabelledResiduals> training, tuning;
  std::vector<LabelledResiduals> runs = twin_residuals(twin, model, labels, first_seed, threads);
  for (std::size_t i = 0; i < runs.size(); ++i)
    (i % 3 == 2 ? tuning : training).push_back(std::move(runs[i]));
  SampleMode mode;
  mode.classifier = train_sample_classifier(training, model.residual).classifier;
  mode.consecutive = tuned(mode.consecutive, mode.classifier, tuning);
  mode.log_odds = tuned(mode.log_odds, mode.classifier, tuning);
  return mode;
}

}  // namespace faultline
