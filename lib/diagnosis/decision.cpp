// SPDX-License-Identifier: MIT
#include "lib/diagnosis/decision.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "lib/fault/fault_words.hpp"

namespace faultline {
namespace {

Opinion opinion_from(const CaseOpinion& opinion) { return {opinion.label, opinion.confidence}; }

DecidedBy decided_by(Settlement settlement) {
  switch (settlement) {
    case Settlement::agreement:
      return DecidedBy::agreement;
    case Settlement::cases:
      return DecidedBy::cases;
    case Settlement::abstained:
      return DecidedBy::abstained;
  }
  return DecidedBy::abstained;
}

void add_precedents(FaultFinding& finding, const CaseDecision& decision) {
  for (const Neighbour& n : decision.precedents)
    finding.precedents.push_back({n.found->id, n.found->label, n.similarity, n.found->what_was_done});
}

void add_second_thoughts(FaultFinding& finding, const Episode& episode, const CaseDecision& decision,
                         double least) {
  if (episode.mlp.label != finding.label && episode.mlp.label.kind != FaultKind::none)
    add_alternative(finding, episode.mlp.label, "the MLP says so");
  if (episode.rbfn.label != finding.label && episode.rbfn.label.kind != FaultKind::none)
    add_alternative(finding, episode.rbfn.label, "the RBFN says so");
  for (const LabelShare& share : decision.shares)
    if (share.share >= least && share.label.kind != FaultKind::none)
      add_alternative(
          finding, share.label,
          fmt::format("similar cases and opinions give it {:.0f} % of the votes", 100.0 * share.share));
}

EvidenceItem remark(const char* name, const std::string& text) {
  EvidenceItem item;
  item.name = name;
  item.text = text;
  return item;
}

EpisodeFacts facts_of(const Episode& episode, const CaseBase& base) {
  EpisodeFacts facts;
  facts.evidence = episode.evidence;
  const auto& features = base.metric().features;
  for (std::size_t i = 0; i < std::min(features.size(), episode.features.size()); ++i)
    facts.features.emplace_back(features[i].name, episode.features[i]);
  return facts;
}

double or_last(double time_s) {
  return std::isnan(time_s) ? std::numeric_limits<double>::infinity() : time_s;
}

std::tuple<double, double, int> order_key(const FaultFinding& finding) {
  return {or_last(finding.onset_s), or_last(finding.alarm_s), finding.label.joint};
}

}  // namespace

void add_alternative(FaultFinding& finding, const FaultLabel& label, std::string why) {
  if (label == finding.label) return;
  for (const Alternative& known : finding.could_also_be)
    if (known.label == label) return;
  if (why.empty()) why = why_alike(finding.label, label);
  finding.could_also_be.push_back(
      {label, why.empty() ? "it explains the log almost as well" : std::move(why)});
}

void apply_decision(FaultFinding& finding, const Episode& episode, const CaseBase& base,
                    const CaseDecision& decision, double least_share) {
  finding.label = decision.label;
  finding.confidence = decision.confidence;
  finding.mlp = opinion_from(episode.mlp);
  finding.rbfn = opinion_from(episode.rbfn);
  finding.decided_by = decided_by(decision.settled_by);
  finding.precedents.clear();
  add_precedents(finding, decision);
  add_second_thoughts(finding, episode, decision, least_share);
  finding.evidence.push_back(remark("decision", decision.why));
  for (const std::string& warning : decision.warnings) finding.evidence.push_back(remark("warning", warning));
  finding.next_check = next_check_for(finding.label);
  finding.episode = facts_of(episode, base);
}

void order_faults(Diagnosis& diagnosis) {
  std::stable_sort(diagnosis.faults.begin(), diagnosis.faults.end(),
                   [](const auto& a, const auto& b) { return order_key(a) < order_key(b); });
  for (std::size_t i = 0; i < diagnosis.faults.size(); ++i) diagnosis.faults[i].id = static_cast<int>(i) + 1;
  if (!diagnosis.faults.empty()) diagnosis.verdict = Verdict::faulty;
}

}  // namespace faultline
