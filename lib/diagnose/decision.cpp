// SPDX-License-Identifier: MIT
#include "lib/diagnose/decision.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "lib/cases/case.hpp"
#include "lib/fault/fault_catalogue.hpp"

namespace faultline {
namespace {

/// Two networks that agree with a lower mean confidence decide nothing.
constexpr double kThinConfidence = 0.2;
constexpr double kSureOfUnknown = 0.9;  // confidence that no known fault has such a misfit

bool explains_the_log(const FaultLabel& label, const DecisionBasis& basis) {
  return label == basis.likeliest ||
         std::find(basis.as_likely.begin(), basis.as_likely.end(), label) != basis.as_likely.end();
}

std::string disagreement(const Episode& episode) {
  return fmt::format("the networks disagree (MLP: {}; RBFN: {})", plain_words(episode.mlp.label),
                     plain_words(episode.rbfn.label));
}

/// ", all simulated," if every case that voted was simulated, else "".
std::string if_simulated(const Votes& votes) {
  const bool all = std::all_of(votes.precedents.begin(), votes.precedents.end(), [](const Neighbour& n) {
    return origin_of(*n.found) == CaseOrigin::simulated;
  });
  return all && !votes.precedents.empty() ? ", all simulated," : "";
}

}  // namespace

Decision opinion_on(const Episode& episode, const Votes& votes) {
  Decision nothing;
  nothing.decided_by = DecidedBy::abstained;
  if (episode.mlp.label == episode.rbfn.label) {
    const double confidence = 0.5 * (episode.mlp.confidence + episode.rbfn.confidence);
    if (confidence < kThinConfidence) return nothing;
    const FaultLabel& label = episode.mlp.label;
    return {label, confidence, DecidedBy::agreement, DecisionReason::networks_agree, label};
  }
  if (votes.precedents.empty() || votes.shares.empty() || votes.shares[0].share <= kClearShare)
    return nothing;
  const auto& [label, share] = votes.shares[0];
  return {label, share, DecidedBy::cases, DecisionReason::votes_settle, label};
}

Decision decide(const DecisionBasis& basis) {
  const Decision opinion = opinion_on(basis.episode, basis.votes);
  if (basis.likeliest.kind == FaultKind::unknown)
    return {{FaultKind::unknown},
            kSureOfUnknown,
            DecidedBy::evidence,
            DecisionReason::no_known_form,
            opinion.label};
  if (explains_the_log(opinion.label, basis)) return opinion;
  const DecisionReason reason =
      opinion.label.kind == FaultKind::none ? DecisionReason::evidence_alone : DecisionReason::log_excludes;
  return {basis.likeliest, posterior_of(basis.likeliest, basis.evidence), DecidedBy::evidence, reason,
          opinion.label};
}

std::string reason_in_words(const Decision& decision, const DecisionBasis& basis) {
  const Episode& episode = basis.episode;
  switch (decision.reason) {
    case DecisionReason::networks_agree:
      return fmt::format("both networks agree: {}", plain_words(decision.label));
    case DecisionReason::votes_settle:
      return fmt::format(
          "{}; of the votes of {} similar cases{} and the opinions, {:.0f} % are for one fault: {}",
          disagreement(episode), basis.votes.precedents.size(), if_simulated(basis.votes),
          100.0 * decision.confidence, plain_words(decision.label));
    case DecisionReason::evidence_alone:
      return "networks and cases give no decision; this fault explains the log best";
    case DecisionReason::log_excludes:
      return fmt::format(
          "networks or cases name a fault ({}) that explains the log much worse than another ({})",
          plain_words(decision.voted), plain_words(decision.label));
    case DecisionReason::no_known_form:
      return "under every known fault the residual of the motion is far larger than noise";
  }
  return "";
}

std::vector<std::string> warnings_of_cases(const Decision& decision, const Votes& votes) {
  std::vector<std::string> warnings;
  if (decision.reason == DecisionReason::networks_agree) {
    if (votes.of_cases.empty())
      warnings.push_back("no recorded case resembles this episode");
    else if (const LabelShare& most = votes.of_cases[0];
             most.label != decision.voted && most.label != decision.label && most.share > kClearShare)
      warnings.push_back(fmt::format("in most similar cases{} the fault was another: {}", if_simulated(votes),
                                     plain_words(most.label)));
  }
  for (const Neighbour& n : votes.precedents)
    if (n.found->outcome == CaseOutcome::rejected && n.found->decision == decision.label)
      warnings.push_back(
          fmt::format("case {} (similarity {:.2f}) had the same diagnosis, {}, which was wrong", n.found->id,
                      n.similarity, plain_words(decision.label)));
  return warnings;
}

}  // namespace faultline
