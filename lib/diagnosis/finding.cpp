// SPDX-License-Identifier: MIT
#include "lib/diagnosis/finding.hpp"

#include <fmt/format.h>

#include <cmath>

#include "lib/diagnosis/alternatives.hpp"
#include "lib/diagnosis/decision_words.hpp"
#include "lib/fault/fault_words.hpp"

namespace faultline {
namespace {

/// How large the fault is by the likeliest hypothesis of its label; empty when no hypothesis bears the label.
std::string size_words(const EpisodeEvidence& observed, const Model& model, const FaultLabel& label) {
  const HypothesisEvidence* best = nullptr;
  for (std::size_t h = 0; h < model.bank.size(); ++h)
    if (model.bank[h].label == label &&
        (!best || observed.hypotheses[h].log_likelihood_ratio > best->log_likelihood_ratio))
      best = &observed.hypotheses[h];
  if (!best) return "";
  const bool turns = model.robot.chain.geometry[label.joint - 1].kind == AxisKind::revolute;
  return size_text(label, best->size, turns);
}

EvidenceItem remark(const char* name, std::string text) {
  return {.name = name, .unit = {}, .text = std::move(text)};
}

std::vector<EvidenceItem> evidence_for(const Decision& decision, const DecisionBasis& basis,
                                       const MonitoredEpisode& observed, const Model& model) {
  std::vector<EvidenceItem> items;
  items.push_back(remark("decision", reason_in_words(decision, basis)));
  for (std::string& warning : warnings_of_cases(decision, basis.votes))
    items.push_back(remark("warning", std::move(warning)));
  items.push_back({"log_likelihood_ratio", basis.episode.evidence, "nats",
                   fmt::format("log likelihood of the fault over a healthy robot (alarm from {:.0f} on)",
                               model.evidence.threshold)});
  if (decision.label.joint > 0)
    if (std::string size = size_words(observed.evidence, model, decision.label); !size.empty())
      items.push_back(remark("size", std::move(size)));
  for (const JointResidual& residual : observed.residuals)
    if (std::isfinite(residual.velocity_rms))
      items.push_back({fmt::format("mlp_velocity_residual_{}", residual.joint), residual.velocity_rms,
                       "times healthy", fmt::format("MLP residual of joint {}", residual.joint)});
  return items;
}

std::vector<Precedent> precedents_of(const Votes& votes) {
  std::vector<Precedent> precedents;
  for (const Neighbour& n : votes.precedents)
    precedents.push_back({n.found->id, n.found->label, n.similarity, n.found->what_was_done});
  return precedents;
}

EpisodeFacts facts_of(const Episode& episode, const std::vector<std::string>& feature_names) {
  EpisodeFacts facts;
  facts.evidence = episode.evidence;
  for (std::size_t i = 0; i < std::min(feature_names.size(), episode.features.size()); ++i)
    facts.features.emplace_back(feature_names[i], episode.features[i]);
  return facts;
}

}  // namespace

FaultFinding finding_of(const Decision& decision, const DecisionBasis& basis,
                        const MonitoredEpisode& observed, const Model& model) {
  FaultFinding finding;
  finding.label = decision.label;
  finding.onset_s = observed.evidence.onset_s;
  finding.alarm_s = observed.evidence.alarm_s;
  finding.end_s = observed.evidence.end_s;
  finding.confidence = decision.confidence;
  finding.mlp = basis.episode.mlp;
  finding.rbfn = basis.episode.rbfn;
  finding.decided_by = decision.decided_by;
  finding.precedents = precedents_of(basis.votes);
  finding.could_also_be = alternatives_to(decision, basis, observed.evidence, model);
  finding.evidence = evidence_for(decision, basis, observed, model);
  finding.next_check = next_check_for(decision.label);
  finding.episode = facts_of(basis.episode, episode_feature_names(model.bank, model.robot.joints()));
  finding.trace = observed.evidence.trace;
  return finding;
}

FaultFinding finding_of(const SampleAlarm& alarm) {
  FaultFinding finding;
  finding.label = alarm.episode.label;
  finding.onset_s = alarm.episode.onset_s;
  finding.alarm_s = alarm.episode.alarm_s;
  finding.end_s = alarm.episode.end_s;
  finding.confidence = alarm.episode.confidence;
  finding.mlp = alarm.opinions.mlp;
  finding.rbfn = alarm.opinions.rbfn;
  finding.decided_by = DecidedBy::criterion;
  finding.could_also_be = alternatives_to(alarm);
  finding.next_check = next_check_for(finding.label);
  return finding;
}

}  // namespace faultline
