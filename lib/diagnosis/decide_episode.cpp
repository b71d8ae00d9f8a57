// SPDX-License-Identifier: MIT
#include "lib/diagnosis/decide_episode.hpp"

#include "lib/diagnosis/decision.hpp"
#include "lib/diagnosis/describe_episode.hpp"
#include "lib/diagnosis/finding.hpp"
#include "lib/diagnosis/least_size.hpp"
#include "lib/diagnosis/precedents.hpp"
#include "lib/evidence/standstill.hpp"

namespace faultline {
namespace {

/// An unknown fault is nothing that the runs held it against had.
double calibrated(const Decision& decision, const ConfidenceCalibration& calibration) {
  if (decision.label.joint == 0 || decision.label.kind == FaultKind::unknown) return decision.confidence;
  return calibration.of(confidence_source(decision.decided_by), decision.confidence);
}

/// An unknown fault whose evidence is too thin to decide gets its likeliest kind when its size is below the
/// least size of that kind. The finding then counts as a small change.
Decision named_if_small(const Decision& decision, const DecisionBasis& basis, const Model& model) {
  if (decision.decided_by != DecidedBy::abstained || decision.label.kind != FaultKind::unknown)
    return decision;
  std::vector<LabelEvidence> known = basis.evidence;
  std::erase_if(known, [](const LabelEvidence& e) { return e.label.kind == FaultKind::unknown; });
  const LabelEvidence likely = likeliest(basis.evidence);
  const bool is_known = !known.empty() && likely.label.joint > 0 && likely.label.kind != FaultKind::unknown;
  if (!is_known || likely.log_likelihood_ratio < basis.threshold) return decision;
  if (is_far_from_white(likely.surprise, basis.usual, true)) return decision;
  if (!(extent_of(likely.label, basis.evidence, model).times_least < 1.0)) return decision;
  return {likely.label, posterior_of(likely.label, known), DecidedBy::evidence,
          DecisionReason::likelihood_names, likely.label};
}

}  // namespace

FaultFinding decide_episode(const MonitoredEpisode& observed, const Model& model, const CaseBase& cases) {
  DescribedEpisode described = describe_episode(observed, model);
  DecisionBasis basis{std::move(described.evidence),
                      std::move(described.episode),
                      {},
                      observed.evidence.usual,
                      observed.evidence.end_s - observed.evidence.onset_s,
                      model.evidence.threshold,
                      {}};
  // A torque that was commanded need not have reached the joint, one measured behind the amplifier has.
  const bool torque_flows = model.robot.log.torque != TorqueMeaning::commanded;
  for (int j = 0; j < model.robot.joints(); ++j)
    basis.is_held[j] = is_held(observed.evidence.standstill[j], torque_flows);
  basis.votes = votes_on(basis.episode, cases);
  Decision decision = named_if_small(decide(basis), basis, model);
  decision.confidence = calibrated(decision, model.confidence);
  FaultFinding finding = finding_of({observed, basis, decision}, model);
  finding.precedents = precedents_of(basis, cases, model);
  return finding;
}

}  // namespace faultline
