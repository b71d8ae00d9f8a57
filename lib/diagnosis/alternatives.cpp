// SPDX-License-Identifier: MIT
#include "lib/diagnosis/alternatives.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace faultline {
namespace {

constexpr double kLeastShare = 0.15;  // of the votes that makes a label worth naming
constexpr double kLeastPush = 0.2;    // of the push on the joint named, each by its joint's usual torque

/// Reasons by label, in the order in which they were given.
class Alternatives {
 public:
  explicit Alternatives(const FaultLabel& of) : of_(of) {}

  void add(const FaultLabel& label, std::string why) {
    if (label == of_ || label.kind == FaultKind::none) return;
    for (const Alternative& known : list)
      if (known.label == label) return;
    list.push_back({label, std::move(why)});
  }

  std::vector<Alternative> list;

 private:
  FaultLabel of_;
};

void add_opinions(Alternatives& alternatives, const Episode& episode) {
  alternatives.add(episode.mlp.label, "the MLP says so");
  alternatives.add(episode.rbfn.label, "the RBFN says so");
}

void add_votes(Alternatives& alternatives, const Votes& votes) {
  for (const LabelShare& share : votes.shares)
    if (share.share >= kLeastShare)
      alternatives.add(share.label, fmt::format("similar cases and opinions give it {:.0f} % of the votes",
                                                100.0 * share.share));
}

double best_ratio(const std::vector<LabelEvidence>& evidence) {
  double best = 0.0;
  for (const LabelEvidence& e : evidence) best = std::max(best, e.log_likelihood_ratio);
  return best;
}

void add_close_labels(Alternatives& alternatives, const std::vector<LabelEvidence>& evidence,
                      const DecisionOptions& options) {
  const double best = best_ratio(evidence);
  for (const LabelEvidence& e : evidence)
    if (e.label.kind != FaultKind::unknown && e.log_likelihood_ratio > best - options.close_ratio)
      alternatives.add(e.label, "explains the log almost as well");
  const LabelEvidence likely = likeliest(evidence);
  if (likely.label.joint > 0) alternatives.add(likely.label, "explains the log best by its likelihood");
}

/// The best hypothesis of a push on all joints at once; null when the bank has none that explains anything.
const HypothesisEvidence* push_on_all_joints(const EpisodeEvidence& observed, const Model& model) {
  const HypothesisEvidence* best = nullptr;
  for (std::size_t h = 0; h < model.bank.size(); ++h)
    if (is_everywhere(model.bank[h]) &&
        (!best || observed.hypotheses[h].log_likelihood_ratio > best->log_likelihood_ratio))
      best = &observed.hypotheses[h];
  return best;
}

void add_pushed_joints(Alternatives& alternatives, const FaultLabel& collision,
                       const std::vector<LabelEvidence>& evidence, const EpisodeEvidence& observed,
                       const Model& model, const DecisionOptions& options) {
  const HypothesisEvidence* everywhere = push_on_all_joints(observed, model);
  if (!everywhere || collision.joint < 1 ||
      everywhere->log_likelihood_ratio < best_ratio(evidence) - options.close_ratio)
    return;
  auto push = [&](int j) { return std::abs(everywhere->impulse[j]) / model.motion.torque_scale[j]; };
  for (int j = 0; j < model.robot.joints(); ++j)
    if (push(j) > kLeastPush * push(collision.joint - 1))
      alternatives.add({FaultKind::collision, j + 1},
                       "the push reached this joint too, as one at the tip does");
}

}  // namespace

std::vector<Alternative> alternatives_to(const DecidedEpisode& decided, const Model& model,
                                         const DecisionOptions& options) {
  const auto& [observed, basis, decision] = decided;
  Alternatives alternatives(decision.label);
  add_opinions(alternatives, basis.episode);
  add_votes(alternatives, basis.votes);
  add_close_labels(alternatives, basis.evidence, options);
  if (decision.label.kind == FaultKind::collision)
    add_pushed_joints(alternatives, decision.label, basis.evidence, observed.evidence, model, options);
  return alternatives.list;
}

std::vector<Alternative> alternatives_to(const SampleAlarm& alarm) {
  Alternatives alternatives(alarm.episode.label);
  for (const Opinion& opinion : {alarm.opinions.mlp, alarm.opinions.rbfn})
    alternatives.add(opinion.label, "one network alone says so");
  return alternatives.list;
}

}  // namespace faultline
