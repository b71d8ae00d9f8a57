// SPDX-License-Identifier: MIT
#include "lib/diagnosis/decision_words.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "lib/cases/case_origin.hpp"
#include "lib/fault/label_text.hpp"

namespace faultline {
namespace {

std::string words(const FaultLabel& label) { return label_text(label, " at joint "); }

std::string disagreement(const Episode& episode) {
  return fmt::format("the networks disagree (MLP {}, RBFN {})", words(episode.mlp.label),
                     words(episode.rbfn.label));
}

/// ", all simulated," where that is all that voted.
std::string if_simulated(const Votes& votes) {
  const bool all = std::all_of(votes.precedents.begin(), votes.precedents.end(), [](const Neighbour& n) {
    return origin_of(*n.found) == CaseOrigin::simulated;
  });
  return all && !votes.precedents.empty() ? ", all simulated," : "";
}

/// That the size of a torque loss gave the fault another name; empty when it did not.
std::string renaming(const Decision& decision) {
  if (decision.label == decision.voted) return "";
  return fmt::format(", and nearly all of it is lost: {}", words(decision.label));
}

}  // namespace

std::string reason_in_words(const Decision& decision, const DecisionBasis& basis,
                            const DecisionOptions& options) {
  const Episode& episode = basis.episode;
  switch (decision.reason) {
    case DecisionReason::thin_evidence:
      return fmt::format("the evidence is thin (log likelihood ratio {:.1f}, {:.1f} asked)", episode.evidence,
                         options.thin_evidence);
    case DecisionReason::hardly_believed:
      return fmt::format("both networks say {}, but hardly believe it (confidence {:.2f})",
                         words(episode.mlp.label), 0.5 * (episode.mlp.confidence + episode.rbfn.confidence));
    case DecisionReason::networks_agree:
      return fmt::format("both networks say {}{}", words(decision.voted), renaming(decision));
    case DecisionReason::nothing_similar:
      return disagreement(episode) + " and no recorded case resembles this episode";
    case DecisionReason::votes_even:
      return disagreement(episode) + " and the similar cases do not settle it";
    case DecisionReason::votes_settle:
      return fmt::format("{}; {} similar cases{} and the opinions give {} {:.0f} % of the votes{}",
                         disagreement(episode), basis.votes.precedents.size(), if_simulated(basis.votes),
                         words(decision.voted), 100.0 * decision.confidence, renaming(decision));
    case DecisionReason::lacks_evidence:
      return fmt::format(
          "networks and cases say {}, but its own likelihood stays below the alarm threshold of {:.0f} nats{}",
          words(decision.voted), basis.threshold,
          decision.label.joint > 0 ? fmt::format("; {} explains the log best", words(decision.label))
                                   : std::string("; and no other fault stands out"));
    case DecisionReason::others_refuted:
      return fmt::format("{} leaves far more of the motion unexplained than noise does; {} does not",
                         words(decision.voted), words(decision.label));
    case DecisionReason::all_refuted:
      return fmt::format(
          "every known fault leaves far more of the motion unexplained than noise does, {} too",
          words(decision.voted));
    case DecisionReason::joint_is_held:
      return fmt::format(
          "{} is ruled out, as the joint stands still while torque acts on it{}", words(decision.voted),
          decision.label.kind == FaultKind::unknown
              ? std::string()
              : fmt::format("; of the other faults {} explains the log best", words(decision.label)));
    case DecisionReason::push_lasts:
      return fmt::format("it begins as {}, but goes on for {:.2g} s", words(decision.voted), basis.lasts_s);
    case DecisionReason::likelihood_names:
      return "neither networks nor cases settle it; this fault explains the log best";
  }
  return "";
}

std::vector<std::string> warnings_of_cases(const Decision& decision, const Votes& votes,
                                           const DecisionOptions& options) {
  std::vector<std::string> warnings;
  if (decision.reason == DecisionReason::networks_agree) {
    if (votes.of_cases.empty())
      warnings.push_back("no recorded case resembles this episode");
    else if (const LabelShare& most = votes.of_cases[0];
             most.label != decision.voted && most.label != decision.label && most.share > options.clear_share)
      warnings.push_back(fmt::format("most similar cases{} were {}", if_simulated(votes), words(most.label)));
  }
  if (decision.reason == DecisionReason::thin_evidence) return warnings;
  for (const Neighbour& n : votes.precedents)
    if (n.found->outcome == CaseOutcome::rejected && n.found->decision == decision.label)
      warnings.push_back(fmt::format("case {} (similarity {:.2f}) was also called {} and that was wrong",
                                     n.found->id, n.similarity, words(decision.label)));
  return warnings;
}

}  // namespace faultline
