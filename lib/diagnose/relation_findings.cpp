// SPDX-License-Identifier: MIT
#include "lib/diagnose/relation_findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/core/number_text.hpp"
#include "lib/diagnose/least_size.hpp"
#include "lib/fault/fault_catalogue.hpp"
#include "lib/fault/fault_kind.hpp"
#include "lib/robot/chain.hpp"

namespace faultline {
namespace {

constexpr double kSure = 0.95, kLess = 0.8;  // confidence well beyond the limit, and just beyond it
constexpr double kWellBeyond = 1.5;          // times the limit that is well beyond it
constexpr double kJolt_s = 0.1;     // longest deviation of a drive as the controller reacts to another one
constexpr double kSettles_s = 0.1;  // and the latest time of its onset after the end of that one

constexpr double kStill = 0.2;               // share of the predicted motion: a joint with less stands still
constexpr double kAsked = 0.5;               // share of it: a reference with more moves
constexpr double kTrackingExplains = 0.5;    // share of the residual that a missing velocity must explain
constexpr double kFindingsSameTime_s = 0.1;  // gap between episodes of position and velocity of one finding

/// The evidence of an episode: its largest mean over the limit, and the log likelihood ratio.
std::vector<EvidenceItem> limit_evidence(const RelationEpisode& episode) {
  return {
      {"times_limit", episode.times_limit, "", "largest mean difference, as a multiple of its limit"},
      {"log_likelihood_ratio", episode.nats, "nats",
       "log likelihood ratio of the signals against no difference"},
  };
}

/// Confidence in an episode, 0 to 1, by how far it exceeds its limit.
double confidence_of(const RelationEpisode& episode) {
  return episode.times_limit > kWellBeyond ? kSure : kLess;
}

bool loses_torque(FaultKind kind) { return column_kind(kind) == FaultKind::torque_loss; }

std::string target_name(const RelationEpisode& episode, const FaultClaim& claim, const std::string& size) {
  if (loses_torque(claim.kind))
    return fmt::format("the measured torque of joint {} is {:.0f} % below the commanded torque",
                       episode.joint, 100.0 * claim.size[0]);
  if (episode.kind == RelationKind::actuator)
    return fmt::format("the measured torque of joint {} differs from the commanded torque by {} on average",
                       episode.joint, size);
  return fmt::format(
      "the commanded torque of joint {} differs from the control law of the healthy logs by {} on average",
      episode.joint, size);
}

std::string next_check_of(const RelationEpisode& episode) {
  if (episode.kind == RelationKind::actuator)
    return fmt::format(
        "Look at the drive of joint {}: its current limit, its supply and its torque or current sensor; "
        "check also whether torque is added behind the controller.",
        episode.joint);
  return fmt::format(
      "Look at the controller of joint {}: another mode, a changed gain or filter, a feed-forward, or a "
      "second program that writes the same command.",
      episode.joint);
}

std::vector<EvidenceItem> evidence_of(const RelationEpisode& episode, const JudgedStretch& judged,
                                      const std::string& unit) {
  const ExplainedFault& fault = judged.fault;
  std::vector<EvidenceItem> items;
  items.push_back({"decision", std::nan(""), "",
                   target_name(episode, fault.claim, value_text(episode.mean) + " " + unit)});
  items.push_back({"torque_difference", episode.mean, unit, "mean difference from onset to end"});
  for (EvidenceItem& item : limit_evidence(episode)) items.push_back(std::move(item));
  if (judged.in_balance > 0.0)
    items.push_back({"motion", judged.in_balance, "nats", "further evidence by the torque balance"});
  if (loses_torque(fault.claim.kind))
    items.push_back(
        {"torque_share", 100.0 * fault.claim.size[0], "%", "share of the commanded torque that is missing"});
  return items;
}

/// Whether the episode is a short deviation of a drive while the controller reacts to that of another joint.
bool answers(const RelationEpisode& episode, const std::vector<RelationEpisode>& all) {
  if (episode.kind != RelationKind::actuator || episode.end_s - episode.onset_s > kJolt_s) return false;
  return std::any_of(all.begin(), all.end(), [&](const RelationEpisode& other) {
    return other.joint != episode.joint && other.kind == RelationKind::actuator &&
           other.end_s - other.onset_s > kJolt_s && episode.onset_s > other.onset_s &&
           (other.lasts || episode.onset_s < other.end_s + kSettles_s);
  });
}

/// Names the target of an episode or a relation.
template <typename Tracked>
const char* target_name(const Tracked& tracked) {
  return tracked.target == Quantity::q ? "position" : "velocity";
}

template <typename Tracked>
const char* unit_of(const Tracked& tracked, const Chain& chain) {
  const AxisKind axis = chain.geometry[tracked.joint.index()].kind;
  return tracked.target == Quantity::q ? position_unit(axis) : velocity_unit(axis);
}

/// Whether the motion predicted at the beginning of the episode comes from its reference, and not from a
/// constant that was learned from motion.
bool reference_moves(const RelationEpisode& episode) {
  const RelationSums& first = episode.at_first;
  if (episode.target == Quantity::dq)
    return first.rms(first.reference_square) > kAsked * first.rms(first.predicted_square);
  return first.reference_high - first.reference_low > kAsked * (first.predicted_high - first.predicted_low);
}

/// Whether the joint stood still at the beginning of the episode while its reference moved; it may catch up
/// later.
bool stands_still(const RelationEpisode& episode) {
  const RelationSums& first = episode.at_first;
  if (!reference_moves(episode)) return false;
  if (episode.target == Quantity::dq)
    return first.share_explains() > kTrackingExplains && std::abs(first.share() - 1.0) < kStill;
  return first.high - first.low < kStill * (first.predicted_high - first.predicted_low);
}

/// Whether joint and reference are at rest: the joint then follows, whatever was learned from motion.
bool rests_as_asked(const RelationEpisode& episode) {
  const RelationSums& first = episode.at_first;
  return episode.target == Quantity::dq && !reference_moves(episode) &&
         first.rms(first.target_square) < kStill * first.rms(first.predicted_square);
}

EvidenceItem difference(const RelationEpisode& episode, const Chain& chain) {
  return {fmt::format("{}_difference", target_name(episode)), episode.strongest, unit_of(episode, chain),
          fmt::format("difference of the {} at its clearest moment", target_name(episode))};
}

std::string next_check_of(Joint joint) {
  return fmt::format(
      "Look at motor, brake, transmission and encoder of joint {}: it stalled, lost steps, was held or "
      "slipped. Home it before it moves again.",
      joint);
}

FaultFinding tracking_finding(const RelationEpisode& episode, const Chain& chain) {
  const bool still = stands_still(episode);
  FaultFinding finding;
  finding.label = {still ? FaultKind::locked : FaultKind::unknown, episode.joint};
  finding.onset_s = episode.onset_s;
  finding.alarm_s = episode.alarm_s;
  finding.end_s = episode.end_s;
  finding.confidence = confidence_of(episode);
  finding.decided_by = DecidedBy::tracking;
  finding.evidence.push_back(
      {"decision", std::nan(""), "",
       fmt::format("joint {} {}: the {} deviates by up to {} {}", episode.joint,
                   still ? "stands still while its reference moves" : "does not follow its reference",
                   target_name(episode), value_text(std::abs(episode.strongest)), unit_of(episode, chain))});
  finding.evidence.push_back(difference(episode, chain));
  for (EvidenceItem& item : limit_evidence(episode)) finding.evidence.push_back(std::move(item));
  finding.next_check = next_check_of(finding.label.joint);
  return finding;
}

bool is_same(const FaultFinding& finding, const RelationEpisode& episode) {
  return finding.label.joint == episode.joint && finding.onset_s <= episode.end_s + kFindingsSameTime_s &&
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

JointTracking tracking_of(Joint joint, const Model& model, const std::vector<double>& judged_s) {
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

std::vector<SignalStretch> stretches_of(const std::vector<RelationEpisode>& episodes, TorqueMeaning torque) {
  std::vector<SignalStretch> out;
  for (std::size_t k = 0; k < episodes.size(); ++k) {
    const RelationEpisode& episode = episodes[k];
    if (answers(episode, episodes)) continue;
    const bool is_drive = episode.kind == RelationKind::actuator;
    out.push_back({.pair = is_drive ? SignalPair::drive : SignalPair::control_law,
                   .joint = episode.joint,
                   .id = k,
                   .onset_s = episode.onset_s,
                   .alarm_s = episode.alarm_s,
                   .end_s = episode.lasts ? kNeverEnds : episode.end_s,
                   .nats = episode.nats,
                   .limit = episode.nats / (episode.times_limit * episode.times_limit),
                   .offset = episode.mean,
                   .loss = episode.share,
                   .loss_explains = episode.share_explains,
                   .offset_explains = episode.offset_explains,
                   .balance_is_of_command = torque == TorqueMeaning::commanded});
  }
  return out;
}

FaultFinding finding_of(const RelationEpisode& episode, const JudgedStretch& judged, double log_end_s,
                        const Model& model) {
  const ExplainedFault& fault = judged.fault;
  FaultFinding finding;
  finding.label = fault.label();
  if (loses_torque(fault.claim.kind)) finding.extent = extent_of_torque_loss(fault.claim.size[0], model);
  finding.onset_s = fault.claim.onset_s;
  finding.alarm_s = std::max(fault.alarm_s, fault.claim.onset_s);
  finding.end_s = std::min(fault.claim.end_s, log_end_s);
  finding.confidence = confidence_of(episode);
  finding.decided_by = episode.kind == RelationKind::actuator ? DecidedBy::actuator : DecidedBy::control_law;
  for (const FaultLabel& label : fault.could_also_be)
    finding.could_also_be.push_back({label, "explains the log almost as well"});
  finding.evidence =
      evidence_of(episode, judged, torque_unit(model.robot.chain.geometry[episode.joint.index()].kind));
  finding.next_check =
      fault.claim.kind == FaultKind::unknown ? next_check_of(episode) : next_check_for(finding.label);
  return finding;
}

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

std::vector<Joint> joints_not_tracked(const Model& model, const std::vector<double>& judged_s) {
  std::vector<Joint> joints;
  for (int j = 0; j < model.robot.joints(); ++j) {
    const JointTracking joint = tracking_of(Joint::at(j), model, judged_s);
    if (joint.is_known && joint.judged.empty()) joints.push_back(Joint::at(j));
  }
  return joints;
}

std::vector<std::string> tracking_spots(const Model& model, const std::vector<double>& judged_s) {
  std::vector<std::string> spots{
      "Without torque only one thing is judged: whether each joint follows its reference as in the healthy "
      "logs. Lost torque, friction, loads, pushes and sensor faults that the controller compensates cannot "
      "be seen."};
  for (int j = 0; j < model.robot.joints(); ++j) {
    const JointTracking joint = tracking_of(Joint::at(j), model, judged_s);
    for (const SignalRelation* relation : joint.judged) {
      const WindowLimit& window = relation->windows[relation->windows.size() / 2];
      spots.push_back(fmt::format(
          "Joint {}: {} errors below {:.2g} {} over {:g} s cannot be distinguished from healthy motion.",
          Joint::at(j), target_name(*relation), window.limit, unit_of(*relation, model.robot.chain),
          window.window_s));
    }
    if (!joint.is_known)
      spots.push_back(fmt::format(
          "Joint {} is not judged: the healthy logs do not show it following a reference.", Joint::at(j)));
    else if (joint.judged.empty())
      spots.push_back(fmt::format(
          "Joint {} is not judged: its reference is missing or never changes in this log, or never resembles "
          "those of the healthy logs, or too few complete rows follow each other.",
          Joint::at(j)));
  }
  return spots;
}

}  // namespace faultline
