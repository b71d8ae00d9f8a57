// SPDX-License-Identifier: MIT
#include "lib/diagnose/decision_words.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "lib/cases/case.hpp"
#include "lib/fault/label_text.hpp"

namespace faultline {
namespace {

std::string words(const FaultLabel& label) { return label_text(label, " at joint "); }

std::string disagreement(const Episode& episode) {
  return fmt::format("the networks disagree (MLP {}, RBFN {})", words(episode.mlp.label),
                     words(episode.rbfn.label));
}

/// ", all simulated," if every case that voted was simulated, else "".
std::string if_simulated(const Votes& votes) {
  const bool all = std::all_of(votes.precedents.begin(), votes.precedents.end(), [](const Neighbour& n) {
    return origin_of(*n.found) == CaseOrigin::simulated;
  });
  return all && !votes.precedents.empty() ? ", all simulated," : "";
}

}  // namespace

std::string reason_in_words(const Decision& decision, const DecisionBasis& basis) {
  const Episode& episode = basis.episode;
  switch (decision.reason) {
    case DecisionReason::networks_agree:
      return fmt::format("both networks name {}", words(decision.label));
    case DecisionReason::votes_settle:
      return fmt::format("{}; {} similar cases{} and the opinions give {} {:.0f} % of the votes",
                         disagreement(episode), basis.votes.precedents.size(), if_simulated(basis.votes),
                         words(decision.label), 100.0 * decision.confidence);
    case DecisionReason::evidence_alone:
      return "networks and cases give no decision; this fault explains the log best";
    case DecisionReason::log_excludes:
      return fmt::format("networks or cases name {}, which explains the log much worse than {}",
                         words(decision.voted), words(decision.label));
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
      warnings.push_back(fmt::format("most similar cases{} were {}", if_simulated(votes), words(most.label)));
  }
  for (const Neighbour& n : votes.precedents)
    if (n.found->outcome == CaseOutcome::rejected && n.found->decision == decision.label)
      warnings.push_back(fmt::format("case {} (similarity {:.2f}) was also diagnosed as {}, wrongly",
                                     n.found->id, n.similarity, words(decision.label)));
  return warnings;
}

}  // namespace faultline
