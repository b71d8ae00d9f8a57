// SPDX-License-Identifier: MIT
#include "lib/diagnose/decide_episode.hpp"

#include "lib/diagnose/finding.hpp"
#include "lib/diagnose/precedents.hpp"

namespace faultline {
namespace {

/// Calibrated confidence; that of an unknown fault is kept, since the calibration runs had no such fault.
double calibrated(const Decision& decision, const ConfidenceCalibration& calibration) {
  if (decision.label.kind == FaultKind::unknown) return decision.confidence;
  return calibration.of(confidence_source(decision.decided_by), decision.confidence);
}

}  // namespace

ConfidenceSource confidence_source(DecidedBy decided_by) {
  if (decided_by == DecidedBy::agreement) return ConfidenceSource::networks;
  return decided_by == DecidedBy::cases ? ConfidenceSource::votes : ConfidenceSource::likelihood;
}

FaultFinding decide_episode(const MonitoredEpisode& observed, const Model& model, const CaseBase& cases) {
  DecisionBasis basis = describe_episode(observed, model);
  basis.votes = votes_on(basis.episode, cases);
  Decision decision = decide(basis);
  decision.confidence = calibrated(decision, model.confidence);
  FaultFinding finding = finding_of({observed, basis, decision}, model);
  finding.precedents = precedents_of(basis, cases, model);
  return finding;
}

DecisionBasis describe_episode(const MonitoredEpisode& observed, const Model& model) {
  DecisionBasis out;
  out.likeliest = observed.fault.label();
  out.as_likely = observed.fault.could_also_be;
  out.limit = observed.fault.limit;
  out.evidence = evidence_by_label(observed.fault, observed.end_s, model.labels, model.motion);
  Episode& episode = out.episode;
  episode.features = episode_features(out.evidence, observed.end_s - observed.onset_s(), observed.residuals,
                                      model.robot.joints());
  episode.evidence = observed.fault.evidence;
  if (!model.episode_classifier.trained()) return out;
  const Opinions opinions = classify_episode(model.episode_classifier, episode.features);
  episode.mlp = opinions.mlp;
  episode.rbfn = opinions.rbfn;
  return out;
}

}  // namespace faultline
