// SPDX-License-Identifier: MIT
#include "lib/cases/decide.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace faultline {
namespace {

std::string words(const FaultLabel& label) {
  return label.joint > 0 ? fmt::format("{} at joint {}", to_string(label.kind), label.joint)
                         : to_string(label.kind);
}

bool fault_is_known(const Case& c) {
  return !(c.outcome == CaseOutcome::rejected && c.label.kind == FaultKind::unknown);
}

std::vector<Neighbour> near_cases(const Episode& episode, const CaseBase& base,
                                  const DecideOptions& options) {
  std::vector<Neighbour> near = retrieve(base, episode.features, options.neighbours);
  const double limit =
      options.near_similarity < 0.0 ? base.metric().near_similarity : options.near_similarity;
  std::erase_if(near, [&](const Neighbour& n) { return n.similarity < limit; });
  return near;
}

void vote(std::vector<LabelShare>& votes, const FaultLabel& label, double weight) {
  const auto known =
      std::find_if(votes.begin(), votes.end(), [&](const auto& v) { return v.label == label; });
  if (known != votes.end())
    known->share += weight;
  else
    votes.push_back({label, weight});
}

void vote_of_cases(std::vector<LabelShare>& votes, const std::vector<Neighbour>& near,
                   const DecideOptions& options) {
  for (const Neighbour& n : near)
    if (fault_is_known(*n.found))
      vote(votes, n.found->label,
           n.similarity * (n.found->outcome == CaseOutcome::unconfirmed ? options.unconfirmed_weight : 1.0));
}

/// Votes as shares of their sum, the largest first; among equals the one voted for first.
void normalise(std::vector<LabelShare>& votes) {
  double sum = 0.0;
  for (const LabelShare& v : votes) sum += v.share;
  if (sum > 0.0)
    for (LabelShare& v : votes) v.share /= sum;
  std::stable_sort(votes.begin(), votes.end(),
                   [](const auto& a, const auto& b) { return a.share > b.share; });
}

void warn_of_rejections(CaseDecision& decision) {
  for (const Neighbour& n : decision.precedents)
    if (n.found->outcome == CaseOutcome::rejected && n.found->decision == decision.label)
      decision.warnings.push_back(
          fmt::format("case {} (similarity {:.2f}) was also called {} and that was wrong", n.found->id,
                      n.similarity, words(decision.label)));
}

CaseDecision abstain(CaseDecision decision, std::string why) {
  decision.label = {FaultKind::unknown, 0};
  decision.settled_by = Settlement::abstained;
  decision.confidence = 0.0;
  decision.why = std::move(why);
  return decision;
}

CaseDecision by_agreement(const Episode& episode, CaseDecision decision, const DecideOptions& options) {
  decision.confidence = 0.5 * (episode.mlp.confidence + episode.rbfn.confidence);
  if (decision.confidence < options.thin_confidence)
    return abstain(std::move(decision),
                   fmt::format("both networks say {}, but hardly believe it (confidence {:.2f})",
                               words(episode.mlp.label), decision.confidence));
  decision.label = episode.mlp.label;
  decision.settled_by = Settlement::agreement;
  decision.why = fmt::format("both networks say {}", words(decision.label));
  std::vector<LabelShare> cases_alone;
  vote_of_cases(cases_alone, decision.precedents, options);
  normalise(cases_alone);
  if (cases_alone.empty())
    decision.warnings.push_back("no recorded case resembles this episode");
  else if (cases_alone[0].label != decision.label && cases_alone[0].share > options.clear_share)
    decision.warnings.push_back(fmt::format("most similar cases were {}", words(cases_alone[0].label)));
  return decision;
}

CaseDecision by_cases(const Episode& episode, CaseDecision decision, const DecideOptions& options) {
  const std::string disagreement = fmt::format("the networks disagree (MLP {}, RBFN {})",
                                               words(episode.mlp.label), words(episode.rbfn.label));
  if (decision.precedents.empty()) {
    decision.label = {FaultKind::unknown, 0};
    decision.settled_by = Settlement::cases;
    decision.why = disagreement + " and no recorded case resembles this episode";
    return decision;
  }
  if (decision.shares.empty() || decision.shares[0].share <= options.clear_share)
    return abstain(std::move(decision), disagreement + " and the similar cases do not settle it");
  decision.label = decision.shares[0].label;
  decision.confidence = decision.shares[0].share;
  decision.settled_by = Settlement::cases;
  decision.why =
      fmt::format("{}; {} similar cases and the opinions give {} {:.0f} % of the votes", disagreement,
                  decision.precedents.size(), words(decision.label), 100.0 * decision.confidence);
  return decision;
}

}  // namespace

CaseDecision decide(const Episode& episode, const CaseBase& base, const DecideOptions& options) {
  CaseDecision decision;
  decision.precedents = near_cases(episode, base, options);
  vote(decision.shares, episode.mlp.label, options.opinion_weight * episode.mlp.confidence);
  vote(decision.shares, episode.rbfn.label, options.opinion_weight * episode.rbfn.confidence);
  vote_of_cases(decision.shares, decision.precedents, options);
  normalise(decision.shares);
  if (episode.evidence < options.thin_evidence)
    return abstain(std::move(decision),
                   fmt::format("the evidence is thin (log likelihood ratio {:.1f}, {:.1f} asked)",
                               episode.evidence, options.thin_evidence));
  const bool agree = episode.mlp.label == episode.rbfn.label;
  decision = agree ? by_agreement(episode, std::move(decision), options)
                   : by_cases(episode, std::move(decision), options);
  warn_of_rejections(decision);
  return decision;
}

}  // namespace faultline
