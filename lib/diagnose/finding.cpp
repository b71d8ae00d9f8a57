// SPDX-License-Identifier: MIT
#include "lib/diagnose/finding.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "lib/core/number_text.hpp"
#include "lib/core/statistics.hpp"
#include "lib/diagnose/decision.hpp"
#include "lib/diagnose/least_size.hpp"
#include "lib/fault/fault_catalogue.hpp"
#include "lib/fault/fault_kind.hpp"

namespace faultline {
namespace {

constexpr double kSureOfFriction = 0.95;  // confidence: below that of its interval, as other kinds may fit

constexpr double kLeastVotes = 0.15;  // of the votes: a label with less is not named as an alternative
constexpr double kLeastPush = 0.2;    // of the push on the named joint, each over its joint's usual torque

/// A list of alternative labels with reasons, each label once, with its first reason.
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
  alternatives.add(episode.mlp.label, "named by the MLP");
  alternatives.add(episode.rbfn.label, "named by the RBFN");
}

void add_votes(Alternatives& alternatives, const Votes& votes) {
  for (const LabelShare& share : votes.shares)
    if (share.share >= kLeastVotes)
      alternatives.add(share.label, fmt::format("similar cases and opinions give it {:.0f} % of the votes",
                                                100.0 * share.share));
}

void add_pushed_joints(Alternatives& alternatives, const MonitoredEpisode& observed, const Model& model) {
  const FaultClaim& claim = observed.fault.claim;
  const int joints = model.robot.joints();
  auto push = [&](int j) { return std::abs(impulse_of(claim, j, joints)) / model.motion.torque_scale[j]; };
  for (int j = 0; j < joints; ++j)
    if (push(j) > kLeastPush * push(claim.joint.index()))
      alternatives.add({FaultKind::collision, Joint::at(j)},
                       "the push also acted on this joint, as a push at the tip does");
}

/// Lists what a fault could also be: the labels with the best evidence and nearly the best, the opinions of
/// both networks, labels with enough votes, and other joints that a collision pushed. Each label once, with
/// its first reason, and never the fault's own.
std::vector<Alternative> alternatives_to(const DecidedEpisode& decided, const Model& model) {
  const auto& [observed, basis, decision] = decided;
  Alternatives alternatives(decision.label);
  if (basis.likeliest.kind != FaultKind::unknown) alternatives.add(basis.likeliest, "explains the log best");
  for (const FaultLabel& label : basis.as_likely)
    alternatives.add(label, basis.likeliest.kind == FaultKind::unknown ? "is the nearest of the known faults"
                                                                       : "explains the log almost as well");
  add_opinions(alternatives, basis.episode);
  add_votes(alternatives, basis.votes);
  if (observed.fault.claim.kind == FaultKind::collision) add_pushed_joints(alternatives, observed, model);
  return alternatives.list;
}

/// Lists the labels that single networks give.
std::vector<Alternative> alternatives_to(const SampleAlarm& alarm) {
  Alternatives alternatives(alarm.episode.label);
  for (const Opinion& opinion : {alarm.opinions.mlp, alarm.opinions.rbfn})
    alternatives.add(opinion.label, "named by one network alone");
  return alternatives.list;
}

/// Describes the size of the named fault; empty if no hypothesis of this label was judged or it has no size.
std::string size_words(const DecidedEpisode& decided, const Model& model) {
  const FaultLabel& label = decided.decision.label;
  for (const LabelScore& score : decided.observed.fault.scores) {
    if (score.label() != label || score.claim.size.size() == 0) continue;
    const bool turns = model.robot.chain.geometry[label.joint.index()].kind == AxisKind::revolute;
    return size_text(label, sizes_of(score.claim, decided.observed.end_s, model.robot.joints()), turns);
  }
  return "";
}

EvidenceItem remark(const char* name, std::string text) {
  return {.name = name, .unit = {}, .text = std::move(text)};
}

/// Lists the evidence on a decision: its reason, warnings from similar cases, the log likelihood ratio, size,
/// residual and misfit of the fault, and the MLP's residual of each joint.
std::vector<EvidenceItem> finding_evidence(const DecidedEpisode& decided, const Model& model) {
  const auto& [observed, basis, decision] = decided;
  std::vector<EvidenceItem> items;
  items.push_back(remark("decision", reason_in_words(decision, basis)));
  for (std::string& warning : warnings_of_cases(decision, basis.votes))
    items.push_back(remark("warning", std::move(warning)));
  items.push_back({"log_likelihood_ratio", basis.episode.evidence, "nats",
                   fmt::format("log-likelihood ratio of the fault to a healthy robot (alarm from {:.0f} on)",
                               basis.limit)});
  if (!decision.label.joint.is_none())
    if (std::string size = size_words(decided, model); !size.empty())
      items.push_back(remark("size", std::move(size)));
  const auto label = std::find_if(basis.evidence.begin(), basis.evidence.end(),
                                  [&](const LabelEvidence& e) { return e.label == decided.decision.label; });
  if (label != basis.evidence.end() && std::isfinite(label->left))
    items.push_back(
        {"left_over", label->left, "times noise",
         fmt::format("residual of the motion under \"{}\" (1 is noise)", plain_words(label->label))});
  if (decision.label.kind == FaultKind::unknown)
    items.push_back({"misfit", observed.fault.misfit, "nats",
                     "by which a free form explains the log better than the nearest known fault"});
  for (const JointResidual& residual : observed.residuals)
    if (std::isfinite(residual.velocity_rms))
      items.push_back({fmt::format("mlp_velocity_residual_{}", residual.joint), residual.velocity_rms,
                       "times healthy", fmt::format("MLP residual of joint {}", residual.joint)});
  return items;
}

EpisodeFacts facts_of(const Episode& episode, const std::vector<std::string>& feature_names) {
  EpisodeFacts facts;
  facts.evidence = episode.evidence;
  for (std::size_t i = 0; i < std::min(feature_names.size(), episode.features.size()); ++i)
    facts.features.emplace_back(feature_names[i], episode.features[i]);
  return facts;
}

constexpr double kFar = 2.0;  // normal ranges: friction above this is a fault

}  // namespace

FaultFinding finding_of(const DecidedEpisode& decided, const Model& model) {
  const auto& [observed, basis, decision] = decided;
  FaultFinding finding;
  finding.label = decision.label;
  finding.extent = extent_of(decision.label, basis.evidence, model);
  finding.onset_s = observed.onset_s();
  finding.alarm_s = observed.alarm_s();
  finding.end_s = observed.end_s;
  finding.confidence = decision.confidence;
  finding.mlp = basis.episode.mlp;
  finding.rbfn = basis.episode.rbfn;
  finding.decided_by = decision.decided_by;
  finding.could_also_be = alternatives_to(decided, model);
  finding.evidence = finding_evidence(decided, model);
  finding.next_check = next_check_for(decision.label);
  finding.episode = facts_of(basis.episode, episode_feature_names(model.labels, model.robot.joints()));
  finding.trace = observed.fault.trace;
  return finding;
}

FaultFinding finding_of(const DayEffect& friction, const LogFacts& log, const Chain& chain) {
  const ConditionItem item = condition_of({friction}, chain).front();
  FaultFinding finding;
  finding.label = {FaultKind::friction_increase, item.joint};
  finding.onset_s = log.start_s;
  finding.alarm_s = log.end_s;
  finding.end_s = log.end_s;
  finding.confidence = kSureOfFriction;
  finding.decided_by = DecidedBy::evidence;
  finding.evidence = {{item.name, item.value, item.unit,
                       fmt::format("{} relative to the identified robot ({} to {} {} with 95 %, normal "
                                   "within {} {}), from the first row on",
                                   item.what, value_text(item.ci95[0]), value_text(item.ci95[1]), item.unit,
                                   value_text(item.normal_range), item.unit)}};
  finding.next_check = next_check_for(finding.label);
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

std::vector<DayEffect> lasting_friction(const std::vector<DayEffect>& day) {
  std::vector<DayEffect> out;
  for (const DayEffect& effect : day)
    if (effect.kind == DayEffectKind::friction &&
        effect.value - kNormal95 * effect.std > kFar * effect.normal_range())
      out.push_back(effect);
  return out;
}

}  // namespace faultline
