// SPDX-License-Identifier: MIT
#include "lib/diagnosis/decision.hpp"

#include <algorithm>
#include <limits>

namespace faultline {
namespace {

constexpr FaultLabel kUnknownFault{FaultKind::unknown, 0};
constexpr double kSureOfUnknown = 0.9;   // that no known fault leaves so much
constexpr double kFarBeyondAlarm = 2.0;  // times the threshold: something is there, whatever it is
constexpr double kLongestPush_s = 5.0;   // what disturbs for longer is no hit

Decision abstained(DecisionReason reason) {
  return {kUnknownFault, 0.0, DecidedBy::abstained, reason, kUnknownFault};
}

Decision by_agreement(const Episode& episode, const DecisionOptions& options) {
  const double confidence = 0.5 * (episode.mlp.confidence + episode.rbfn.confidence);
  if (confidence < options.thin_confidence) return abstained(DecisionReason::hardly_believed);
  const FaultLabel& label = episode.mlp.label;
  return {label, confidence, DecidedBy::agreement, DecisionReason::networks_agree, label};
}

Decision by_votes(const Votes& votes, const DecisionOptions& options) {
  if (votes.precedents.empty())
    return {kUnknownFault, 0.0, DecidedBy::cases, DecisionReason::nothing_similar, kUnknownFault};
  if (votes.shares.empty() || votes.shares[0].share <= options.clear_share)
    return abstained(DecisionReason::votes_even);
  const auto& [label, share] = votes.shares[0];
  return {label, share, DecidedBy::cases, DecisionReason::votes_settle, label};
}

/// How far the likelihood of `label` is ahead of that of every other known fault, nats.
double lead_of(const LabelEvidence& likely, const std::vector<LabelEvidence>& evidence) {
  double second = -std::numeric_limits<double>::infinity();
  for (const LabelEvidence& e : evidence)
    if (e.label.kind != FaultKind::unknown && named_by_size(e.label, evidence) != likely.label)
      second = std::max(second, e.log_likelihood_ratio);
  return likely.log_likelihood_ratio - second;
}

/// Without unknown disturbances, which explain anything.
std::vector<LabelEvidence> known(std::vector<LabelEvidence> evidence) {
  std::erase_if(evidence, [](const LabelEvidence& e) { return e.label.kind == FaultKind::unknown; });
  return evidence;
}

Decision by_likelihood(const Decision& unnamed, const DecisionBasis& basis, const DecisionOptions& options) {
  const LabelEvidence likely = likeliest(basis.evidence);
  if (likely.label.kind == FaultKind::unknown) return unnamed;
  const bool seconded = likely.label == basis.episode.mlp.label || likely.label == basis.episode.rbfn.label;
  if (!seconded && lead_of(likely, basis.evidence) < options.close_ratio) return unnamed;
  return {likely.label, posterior_of(likely.label, known(basis.evidence)), DecidedBy::evidence,
          DecisionReason::likelihood_names, likely.label};
}

/// A repeated code is all that a stuck encoder is told by, and the other joints miss its readings.
bool is_refuted(const LabelEvidence& evidence, const Surprise& usual) {
  const FaultKind kind = evidence.label.kind;
  const bool is_specific = !describe(kind).passes && kind != FaultKind::unknown;
  return kind != FaultKind::stuck_encoder && is_far_from_white(evidence.surprise, usual, is_specific);
}

const LabelEvidence* find(const FaultLabel& label, const std::vector<LabelEvidence>& evidence) {
  const auto found = std::find_if(evidence.begin(), evidence.end(),
                                  [&](const LabelEvidence& e) { return e.label == label; });
  return found == evidence.end() ? nullptr : &*found;
}

/// Of the faults that are known.
const LabelEvidence* likeliest_known(const std::vector<LabelEvidence>& evidence) {
  const LabelEvidence* best = nullptr;
  for (const LabelEvidence& e : evidence)
    if (e.label.kind != FaultKind::unknown &&
        (best == nullptr || e.log_likelihood_ratio > best->log_likelihood_ratio))
      best = &e;
  return best;
}

/// What is left of a decision whose name must have raised the alarm by itself. Where it did not, and the
/// alarm was just passed by faults of which none stands out, nothing was found that could be named or
/// plotted.
Decision unless_without_evidence(const Decision& decision, const DecisionBasis& basis,
                                 const DecisionOptions& options) {
  const auto reaches = [&](const FaultLabel& label) {
    const LabelEvidence* const evidence = find(label, basis.evidence);
    return evidence != nullptr && evidence->log_likelihood_ratio >= basis.threshold;
  };
  if (decision.label.kind == FaultKind::unknown || basis.evidence.empty() || reaches(decision.label) ||
      reaches(decision.voted))
    return decision;
  const LabelEvidence& best = *likeliest_known(basis.evidence);
  const FaultLabel label = named_by_size(best.label, basis.evidence);
  constexpr DecisionReason kReason = DecisionReason::lacks_evidence;
  if (best.log_likelihood_ratio >= basis.threshold && lead_of(best, basis.evidence) >= options.close_ratio)
    return {label, posterior_of(label, known(basis.evidence)), DecidedBy::evidence, kReason, decision.voted};
  if (best.log_likelihood_ratio >= kFarBeyondAlarm * basis.threshold)
    return {kUnknownFault, 0.0, DecidedBy::abstained, kReason, decision.voted};
  return {{FaultKind::none, 0}, 0.0, DecidedBy::abstained, kReason, decision.voted};
}

/// What is left of a decision once the innovations are looked at.
Decision unless_refuted(const Decision& decision, const DecisionBasis& basis) {
  const auto refuted = [&](const FaultLabel& label) {
    const LabelEvidence* const evidence = find(label, basis.evidence);
    return evidence != nullptr && is_refuted(*evidence, basis.usual);
  };
  if (decision.label.kind == FaultKind::unknown || !refuted(decision.label) || !refuted(decision.voted))
    return decision;
  const LabelEvidence* const best = likeliest_known(basis.evidence);
  if (!is_refuted(*best, basis.usual)) {
    const FaultLabel label = named_by_size(best->label, basis.evidence);
    return {label, posterior_of(label, known(basis.evidence)), DecidedBy::evidence,
            DecisionReason::others_refuted, decision.voted};
  }
  return {kUnknownFault, kSureOfUnknown, DecidedBy::evidence, DecisionReason::all_refuted, decision.voted};
}

bool loses_torque(const FaultLabel& label) {
  return label.kind == FaultKind::free_swinging || label.kind == FaultKind::torque_loss;
}

/// A joint that does not move under torque has not lost it: something holds it.
Decision unless_held(const Decision& decision, const DecisionBasis& basis) {
  const FaultLabel& lost = decision.label;
  if (!loses_torque(lost) || !basis.is_held[lost.joint - 1]) return decision;
  std::vector<LabelEvidence> others = known(basis.evidence);
  std::erase_if(others,
                [&](const LabelEvidence& e) { return loses_torque(e.label) && e.label.joint == lost.joint; });
  const LabelEvidence* const best = likeliest_known(others);
  if (best == nullptr || !(best->log_likelihood_ratio > 0.0))
    return {kUnknownFault, kSureOfUnknown, DecidedBy::evidence, DecisionReason::joint_is_held, lost};
  return {best->label, posterior_of(best->label, others), DecidedBy::evidence, DecisionReason::joint_is_held,
          lost};
}

Decision unless_it_lasts(const Decision& decision, double lasts_s) {
  if (!describe(decision.label.kind).passes || !(lasts_s > kLongestPush_s)) return decision;
  return {kUnknownFault, kSureOfUnknown, DecidedBy::evidence, DecisionReason::push_lasts, decision.label};
}

}  // namespace

Decision decide(const DecisionBasis& basis, const DecisionOptions& options) {
  const Episode& episode = basis.episode;
  const bool agree = episode.mlp.label == episode.rbfn.label;
  Decision decision = episode.evidence < options.thin_evidence ? abstained(DecisionReason::thin_evidence)
                      : agree                                  ? by_agreement(episode, options)
                                                               : by_votes(basis.votes, options);
  decision.label = named_by_size(decision.label, basis.evidence);
  const bool unnamed = decision.label.kind == FaultKind::unknown;
  if (unnamed && !basis.evidence.empty()) decision = by_likelihood(decision, basis, options);
  decision = unless_held(unless_refuted(unless_without_evidence(decision, basis, options), basis), basis);
  return unless_it_lasts(decision, basis.lasts_s);
}

}  // namespace faultline
