// SPDX-License-Identifier: MIT
#include "lib/diagnose/decision.hpp"

#include <algorithm>

namespace faultline {
namespace {

constexpr FaultLabel kUnknownFault{FaultKind::unknown, 0};
/// Two networks that agree with a lower mean confidence decide nothing.
constexpr double kThinConfidence = 0.2;
constexpr double kSureOfUnknown = 0.9;  // confidence that no known fault has such a misfit

bool explains_the_log(const FaultLabel& label, const DecisionBasis& basis) {
  return label == basis.likeliest ||
         std::find(basis.as_likely.begin(), basis.as_likely.end(), label) != basis.as_likely.end();
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
    return {kUnknownFault, kSureOfUnknown, DecidedBy::evidence, DecisionReason::no_known_form, opinion.label};
  if (explains_the_log(opinion.label, basis)) return opinion;
  const DecisionReason reason =
      opinion.label.kind == FaultKind::none ? DecisionReason::evidence_alone : DecisionReason::log_excludes;
  return {basis.likeliest, posterior_of(basis.likeliest, basis.evidence), DecidedBy::evidence, reason,
          opinion.label};
}

}  // namespace faultline
