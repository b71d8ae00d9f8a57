// SPDX-License-Identifier: MIT
#include "lib/monitor/listen_to_samples.hpp"

#include <algorithm>

#include "lib/diagnosis/decision.hpp"
#include "lib/fault/fault_words.hpp"
#include "lib/residual/residuals.hpp"

namespace faultline {
namespace {

/// The criterion applied to one series of outputs along a log.
class Criterion {
 public:
  Criterion(const CriterionOptions& options, const OutputMeaning& meaning)
      : options_(options), meaning_(meaning) {}

  void take(const Eigen::VectorXd& time, const Eigen::MatrixXd& outputs) {
    for (const SampleEpisode& episode : apply_criterion(options_, meaning_, time, outputs, state_))
      episodes.push_back(episode);
  }
  void finish() {
    if (const auto open = open_episode(meaning_, state_)) episodes.push_back(*open);
  }

  std::vector<SampleEpisode> episodes;

 private:
  const CriterionOptions& options_;
  const OutputMeaning& meaning_;
  CriterionState state_;
};

/// What one network alone says about the time of an episode.
Opinion opinion_on(const SampleEpisode& episode, const std::vector<SampleEpisode>& own) {
  for (const SampleEpisode& other : own)
    if (other.alarm_s <= episode.end_s && other.end_s >= episode.onset_s)
      return {other.label, other.confidence};
  return {};
}

FaultFinding finding_of(const SampleEpisode& episode, const Criterion& mlp, const Criterion& rbfn) {
  FaultFinding finding;
  finding.label = episode.label;
  finding.onset_s = episode.onset_s;
  finding.alarm_s = episode.alarm_s;
  finding.end_s = episode.end_s;
  finding.confidence = episode.confidence;
  finding.mlp = opinion_on(episode, mlp.episodes);
  finding.rbfn = opinion_on(episode, rbfn.episodes);
  finding.decided_by = DecidedBy::criterion;
  finding.next_check = next_check_for(finding.label);
  for (const Opinion& opinion : {finding.mlp, finding.rbfn})
    if (opinion.label.kind != FaultKind::none)
      add_alternative(finding, opinion.label, "one network alone says so");
  return finding;
}

}  // namespace

HeardSamples listen_to_samples(LogSource& log, const Model& model, const CriterionOptions& criterion) {
  const OutputMeaning meaning{model.samples.classifier.classes, model.samples.classifier.prior};
  Criterion average(criterion, meaning), mlp(criterion, meaning), rbfn(criterion, meaning);
  HeardSamples heard;
  ResidualState state;
  ResidualSummary whole;
  for (Log segment; log.next(segment);) {
    heard.tally.take(segment, log, model);
    const Residuals residuals = compute_residuals(model.residual, segment, state);
    whole.add(residuals);
    const SampleOutputs outputs = classify_samples(model.samples.classifier, residuals);
    average.take(outputs.time, outputs.average());
    mlp.take(outputs.time, outputs.mlp);
    rbfn.take(outputs.time, outputs.rbfn);
  }
  for (Criterion* each : {&average, &mlp, &rbfn}) each->finish();
  heard.residuals = whole.joints();
  for (const SampleEpisode& episode : average.episodes)
    heard.faults.push_back(finding_of(episode, mlp, rbfn));
  return heard;
}

}  // namespace faultline
