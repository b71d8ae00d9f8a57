// SPDX-License-Identifier: MIT
#include "lib/diagnose/relation/relation_findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/core/number_text.hpp"
#include "lib/diagnose/least_size.hpp"
#include "lib/fault/fault_kind.hpp"
#include "lib/fault/fault_words.hpp"
#include "lib/robot/chain.hpp"

namespace faultline {
namespace {

constexpr double kSure = 0.95, kLess = 0.8;  // confidence well beyond the limit, and just beyond it
constexpr double kWellBeyond = 1.5;          // times the limit that is well beyond it
constexpr double kJolt_s = 0.1;     // longest deviation of a drive as the controller reacts to another one
constexpr double kSettles_s = 0.1;  // and the latest time of its onset after the end of that one

bool loses_torque(FaultKind kind) { return column_kind(kind) == FaultKind::torque_loss; }

std::string target_name(const RelationEpisode& episode, const FaultClaim& claim, const std::string& size) {
  if (loses_torque(claim.kind))
    return fmt::format("the measured torque of joint {} is {:.0f} % below the commanded torque",
                       episode.joint + 1, 100.0 * claim.size[0]);
  if (episode.kind == RelationKind::actuator)
    return fmt::format("the measured torque of joint {} differs from the commanded torque by {} on average",
                       episode.joint + 1, size);
  return fmt::format(
      "the commanded torque of joint {} differs from the control law of the healthy logs by {} on average",
      episode.joint + 1, size);
}

std::string next_check_of(const RelationEpisode& episode) {
  if (episode.kind == RelationKind::actuator)
    return fmt::format(
        "Look at the drive of joint {}: its current limit, its supply and its torque or current sensor; "
        "check also whether torque is added behind the controller.",
        episode.joint + 1);
  return fmt::format(
      "Look at the controller of joint {}: another mode, a changed gain or filter, a feed-forward, or a "
      "second program that writes the same command.",
      episode.joint + 1);
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

}  // namespace

std::vector<EvidenceItem> limit_evidence(const RelationEpisode& episode) {
  return {
      {"times_limit", episode.times_limit, "", "largest mean difference, as a multiple of its limit"},
      {"log_likelihood_ratio", episode.nats, "nats",
       "log likelihood ratio of the signals against no difference"},
  };
}

double confidence_of(const RelationEpisode& episode) {
  return episode.times_limit > kWellBeyond ? kSure : kLess;
}

std::vector<SignalStretch> stretches_of(const std::vector<RelationEpisode>& episodes, TorqueMeaning torque) {
  std::vector<SignalStretch> out;
  for (std::size_t k = 0; k < episodes.size(); ++k) {
    const RelationEpisode& episode = episodes[k];
    if (answers(episode, episodes)) continue;
    const bool is_drive = episode.kind == RelationKind::actuator;
    out.push_back({.pair = is_drive ? SignalPair::drive : SignalPair::control_law,
                   .joint = episode.joint + 1,
                   .id = k,
                   .onset_s = episode.onset_s,
                   .alarm_s = episode.alarm_s,
                   .end_s = episode.lasts ? kNeverEnds : episode.end_s,
                   .nats = episode.nats,
                   .limit = episode.nats / (episode.times_limit * episode.times_limit),
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
      evidence_of(episode, judged, torque_unit(model.robot.chain.geometry[episode.joint].kind));
  finding.next_check =
      fault.claim.kind == FaultKind::unknown ? next_check_of(episode) : next_check_for(finding.label);
  return finding;
}

}  // namespace faultline
