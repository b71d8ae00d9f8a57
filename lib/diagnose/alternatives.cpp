// SPDX-License-Identifier: MIT
#include "lib/diagnose/alternatives.hpp"

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

void add_pushed_joints(Alternatives& alternatives, const MonitoredEpisode& observed, const Model& model) {
  const FaultClaim& claim = observed.fault.claim;
  const int joints = model.robot.joints();
  auto push = [&](int j) { return std::abs(impulse_of(claim, j, joints)) / model.motion.torque_scale[j]; };
  for (int j = 0; j < joints; ++j)
    if (push(j) > kLeastPush * push(claim.joint - 1))
      alternatives.add({FaultKind::collision, j + 1},
                       "the push reached this joint too, as one at the tip does");
}

}  // namespace

std::vector<Alternative> alternatives_to(const DecidedEpisode& decided, const Model& model) {
  const auto& [observed, basis, decision] = decided;
  Alternatives alternatives(decision.label);
  if (basis.likeliest.kind != FaultKind::unknown) alternatives.add(basis.likeliest, "explains the log best");
  for (const FaultLabel& label : basis.as_likely)
    alternatives.add(label, basis.likeliest.kind == FaultKind::unknown ? "comes nearest of the known faults"
                                                                       : "explains the log almost as well");
  add_opinions(alternatives, basis.episode);
  add_votes(alternatives, basis.votes);
  if (observed.fault.claim.kind == FaultKind::collision) add_pushed_joints(alternatives, observed, model);
  return alternatives.list;
}

std::vector<Alternative> alternatives_to(const SampleAlarm& alarm) {
  Alternatives alternatives(alarm.episode.label);
  for (const Opinion& opinion : {alarm.opinions.mlp, alarm.opinions.rbfn})
    alternatives.add(opinion.label, "one network alone says so");
  return alternatives.list;
}

}  // namespace faultline
