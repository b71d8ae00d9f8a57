// SPDX-License-Identifier: MIT
#include "lib/diagnose/relation/tracking_findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/core/number_text.hpp"
#include "lib/diagnose/relation/relation_findings.hpp"
#include "lib/fault/fault_words.hpp"
#include "lib/robot/chain.hpp"

namespace faultline {
namespace {

constexpr double kStill = 0.2;               // share of the predicted motion: a joint with less stands still
constexpr double kAsked = 0.5;               // share of it: a reference with more moves
constexpr double kTrackingExplains = 0.5;    // share of the residual that a missing velocity must explain
constexpr double kFindingsSameTime_s = 0.1;  // gap between episodes of position and velocity of one finding

/// Names the target of an episode or a relation.
template <typename Tracked>
const char* target_name(const Tracked& tracked) {
  return tracked.target == Quantity::q ? "position" : "velocity";
}

template <typename Tracked>
const char* unit_of(const Tracked& tracked, const Chain& chain) {
  const AxisKind axis = chain.geometry[tracked.joint].kind;
  return tracked.target == Quantity::q ? position_unit(axis) : velocity_unit(axis);
}

/// Whether the motion predicted at the beginning of the episode comes from its reference, and not from a
/// constant that was learned from motion.
bool reference_moves(const RelationEpisode& episode) {
  if (episode.target == Quantity::dq)
    return episode.first_reference_rms > kAsked * episode.first_predicted_rms;
  return episode.first_reference_span > kAsked * episode.first_predicted_span;
}

/// Whether the joint stood still at the beginning of the episode while its reference moved; it may catch up
/// later.
bool stands_still(const RelationEpisode& episode) {
  if (!reference_moves(episode)) return false;
  if (episode.target == Quantity::dq)
    return episode.first_share_explains > kTrackingExplains && std::abs(episode.first_share - 1.0) < kStill;
  return episode.first_span < kStill * episode.first_predicted_span;
}

/// Whether joint and reference are at rest: the joint then follows, whatever was learned from motion.
bool rests_as_asked(const RelationEpisode& episode) {
  return episode.target == Quantity::dq && !reference_moves(episode) &&
         episode.first_rms < kStill * episode.first_predicted_rms;
}

EvidenceItem difference(const RelationEpisode& episode, const Chain& chain) {
  return {fmt::format("{}_difference", target_name(episode)), episode.strongest, unit_of(episode, chain),
          fmt::format("difference of the {} at its clearest moment", target_name(episode))};
}

std::string next_check_of(int joint) {
  return fmt::format(
      "Look at motor, brake, transmission and encoder of joint {}: it stalled, lost steps, was held or "
      "slipped. Home it before it moves again.",
      joint);
}

FaultFinding tracking_finding(const RelationEpisode& episode, const Chain& chain) {
  const bool still = stands_still(episode);
  FaultFinding finding;
  finding.label = {still ? FaultKind::locked : FaultKind::unknown, episode.joint + 1};
  finding.onset_s = episode.onset_s;
  finding.alarm_s = episode.alarm_s;
  finding.end_s = episode.end_s;
  finding.confidence = confidence_of(episode);
  finding.decided_by = DecidedBy::tracking;
  finding.evidence.push_back(
      {"decision", std::nan(""), "",
       fmt::format("joint {} {}: the {} deviates by up to {} {}", episode.joint + 1,
                   still ? "stands still while its reference moves" : "does not follow its reference",
                   target_name(episode), value_text(std::abs(episode.strongest)), unit_of(episode, chain))});
  finding.evidence.push_back(difference(episode, chain));
  for (EvidenceItem& item : limit_evidence(episode)) finding.evidence.push_back(std::move(item));
  finding.next_check = next_check_of(finding.label.joint);
  return finding;
}

bool is_same(const FaultFinding& finding, const RelationEpisode& episode) {
  return finding.label.joint == episode.joint + 1 && finding.onset_s <= episode.end_s + kFindingsSameTime_s &&
         finding.end_s >= episode.onset_s - kFindingsSameTime_s;
}

/// Merges two findings of one joint; the one that names a kind keeps its label and texts.
void join(FaultFinding& finding, FaultFinding more, const EvidenceItem& of_more) {
  const double onset_s = std::min(finding.onset_s, more.onset_s);
  const double alarm_s = std::min(finding.alarm_s, more.alarm_s);
  const double end_s = std::max(finding.end_s, more.end_s);
  EvidenceItem other = of_more;
  if (finding.label.kind == FaultKind::unknown && more.label.kind != FaultKind::unknown) {
    other = finding.evidence[1];
    finding = std::move(more);
  }
  finding.onset_s = onset_s, finding.alarm_s = alarm_s, finding.end_s = end_s;
  finding.evidence.push_back(std::move(other));
}

/// The tracking relations of one joint: whether the model has any, and those that were judged in a log.
struct JointTracking {
  bool is_known = false;
  std::vector<const SignalRelation*> judged{};
};

JointTracking tracking_of(int joint, const Model& model, const std::vector<double>& judged_s) {
  JointTracking out;
  for (std::size_t i = 0; i < model.relations.size(); ++i) {
    const SignalRelation& relation = model.relations[i];
    if (relation.kind != RelationKind::tracking || relation.joint != joint) continue;
    out.is_known = true;
    if (judged_s[i] > 0.0) out.judged.push_back(&relation);
  }
  return out;
}

}  // namespace

std::vector<FaultFinding> tracking_findings(const std::vector<RelationEpisode>& episodes,
                                            const Chain& chain) {
  std::vector<FaultFinding> found;
  for (const RelationEpisode& episode : episodes) {
    if (rests_as_asked(episode)) continue;
    const auto same =
        std::find_if(found.begin(), found.end(), [&](const auto& f) { return is_same(f, episode); });
    if (same == found.end())
      found.push_back(tracking_finding(episode, chain));
    else
      join(*same, tracking_finding(episode, chain), difference(episode, chain));
  }
  return found;
}

std::int64_t rows_tracked(const Model& model, const std::vector<double>& judged_s) {
  double longest_s = 0.0;
  for (const double judged : judged_s) longest_s = std::max(longest_s, judged);
  return static_cast<std::int64_t>(longest_s / model.sample_period_s + 0.5);
}

std::vector<int> joints_not_tracked(const Model& model, const std::vector<double>& judged_s) {
  std::vector<int> joints;
  for (int j = 0; j < model.robot.joints(); ++j) {
    const JointTracking joint = tracking_of(j, model, judged_s);
    if (joint.is_known && joint.judged.empty()) joints.push_back(j + 1);
  }
  return joints;
}

std::vector<std::string> tracking_spots(const Model& model, const std::vector<double>& judged_s) {
  std::vector<std::string> spots{
      "Without torque only one thing is judged: whether each joint follows its reference as in the healthy "
      "logs. Lost torque, friction, loads, pushes and sensor faults that the controller compensates cannot "
      "be seen."};
  for (int j = 0; j < model.robot.joints(); ++j) {
    const JointTracking joint = tracking_of(j, model, judged_s);
    for (const SignalRelation* relation : joint.judged) {
      const WindowLimit& window = relation->windows[relation->windows.size() / 2];
      spots.push_back(fmt::format(
          "Joint {}: {} errors below {:.2g} {} over {:g} s cannot be distinguished from healthy motion.",
          j + 1, target_name(*relation), window.limit, unit_of(*relation, model.robot.chain),
          window.window_s));
    }
    if (!joint.is_known)
      spots.push_back(fmt::format(
          "Joint {} is not judged: the healthy logs do not show it following a reference.", j + 1));
    else if (joint.judged.empty())
      spots.push_back(fmt::format(
          "Joint {} is not judged: its reference is missing or never changes in this log, or never resembles "
          "those of the healthy logs, or too few complete rows follow each other.",
          j + 1));
  }
  return spots;
}

}  // namespace faultline
