// SPDX-License-Identifier: MIT
#include "lib/diagnose/relation/relation_findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/core/number_text.hpp"
#include "lib/fault/fault_words.hpp"
#include "lib/fault/label_text.hpp"
#include "lib/robot/axis_units.hpp"

namespace faultline {
namespace {

constexpr double kLostShare = 0.1;           // of the command, which a technician calls a loss of torque
constexpr double kShareExplains = 0.5;       // of the residual: a share of the command, not an offset
constexpr double kShareMayExplain = 0.3;     // the same where the motion says so too
constexpr double kBetterThanOffset = 0.5;    // times what a constant leaves of it
constexpr double kAll = 1.2;                 // of the command: what is missing beyond it was turned around
constexpr double kSure = 0.95, kLess = 0.8;  // confidence well beyond the limit, and just beyond it
constexpr double kWellBeyond = 1.5;          // times the limit
constexpr double kSameTime_s = 0.1;          // the motion may show it so much sooner
constexpr double kAftermath_s = 0.3;         // and so long after it has ended
constexpr double kVague_s = 1.0;    // by which onset and alarm estimated from the motion may be early or late
constexpr double kLeftLaw_s = 1.0;  // a law that is left for longer after a fault follows from it
constexpr double kConstant = 0.7;   // of the residual, which a constant explains: a sensor's offset
constexpr double kStays_s = 1.0;    // for which a sensor that is off stays so at least
constexpr double kJolt_s = 0.1;     // another drive may stray for so long meanwhile

bool is_lost_torque(const RelationEpisode& episode) {
  const bool as_a_share = episode.share_explains > kShareExplains &&
                          1.0 - episode.share_explains < kBetterThanOffset * (1.0 - episode.offset_explains);
  return episode.kind == RelationKind::actuator && as_a_share && episode.share > kLostShare &&
         episode.share < kAll;
}

std::string what_strayed(const RelationEpisode& episode, const std::string& size) {
  if (is_lost_torque(episode))
    return fmt::format("the measured torque of joint {} is {:.0f} % less than what was commanded",
                       episode.joint + 1, 100.0 * episode.share);
  if (episode.kind == RelationKind::actuator)
    return fmt::format("the measured torque of joint {} is not what was commanded: {} on average",
                       episode.joint + 1, size);
  return fmt::format(
      "the commanded torque of joint {} is not what the controller makes of reference and motion: {} on average",
      episode.joint + 1, size);
}

std::string next_check_of(const RelationEpisode& episode) {
  if (episode.kind == RelationKind::actuator)
    return fmt::format(
        "Look at the drive of joint {}: its current limit, its supply and its torque or current sensor; somebody "
        "may have added torque behind the controller.",
        episode.joint + 1);
  return fmt::format(
      "Look at what commands joint {}: another controller mode, a changed gain or filter, a feed-forward, or "
      "somebody who writes to the same command.",
      episode.joint + 1);
}

std::vector<EvidenceItem> evidence_of(const RelationEpisode& episode, const std::string& unit) {
  std::vector<EvidenceItem> items;
  items.push_back(
      {"decision", std::nan(""), "", what_strayed(episode, value_text(episode.mean) + " " + unit)});
  items.push_back({"torque_difference", episode.mean, unit, "mean difference from onset to end"});
  for (EvidenceItem& item : limit_evidence(episode)) items.push_back(std::move(item));
  if (is_lost_torque(episode))
    items.push_back(
        {"torque_share", 100.0 * episode.share, "%", "share of the commanded torque that is missing"});
  return items;
}

bool loses_torque(FaultKind kind) {
  return kind == FaultKind::torque_loss || kind == FaultKind::free_swinging;
}

double end_of(const RelationEpisode& episode) {
  return episode.lasts ? std::numeric_limits<double>::infinity() : episode.end_s;
}

/// Whether the motion shows the same cause. The motion may date an onset too early, so that a finding that
/// begins a while before the episode and overlaps it is of one cause with it where its alarm came with it.
bool has_same_cause(const FaultFinding& finding, const RelationEpisode& episode) {
  const bool begins_within =
      finding.onset_s >= episode.onset_s - kSameTime_s && finding.onset_s <= end_of(episode) + kAftermath_s;
  const bool begins_before =
      finding.onset_s > episode.onset_s - kVague_s && finding.onset_s < episode.onset_s;
  const bool overlaps = !(finding.end_s < episode.onset_s - kSameTime_s);
  const bool alarms_with_it =
      finding.alarm_s >= episode.onset_s - kAftermath_s && finding.alarm_s <= end_of(episode) + kVague_s;
  return begins_within || (begins_before && overlaps && alarms_with_it);
}

/// A law that is left while another fault lasts, or for long after one: the controller's answer to it.
bool follows_from(const RelationEpisode& episode, const std::vector<FaultFinding>& others) {
  if (episode.kind != RelationKind::control_law) return false;
  const bool is_long = episode.end_s - episode.onset_s >= kLeftLaw_s;
  return std::any_of(others.begin(), others.end(), [&](const FaultFinding& other) {
    return other.onset_s < episode.onset_s + kSameTime_s &&
           (is_long || !(other.end_s < episode.onset_s - kSameTime_s));
  });
}

/// A jolt of another drive while the controller answers to what is going on.
bool answers(const RelationEpisode& episode, const std::vector<RelationEpisode>& all) {
  if (episode.kind != RelationKind::actuator || episode.end_s - episode.onset_s > kJolt_s) return false;
  return std::any_of(all.begin(), all.end(), [&](const RelationEpisode& other) {
    return other.joint != episode.joint && other.kind == RelationKind::actuator &&
           other.end_s - other.onset_s > kJolt_s && episode.onset_s > other.onset_s &&
           episode.onset_s < end_of(other) + kSameTime_s;
  });
}

/// Whether the drive gave less than was commanded, so that a loss of torque may be true.
bool gave_less(const RelationEpisode& episode) {
  return episode.kind == RelationKind::actuator && episode.share > kLostShare &&
         episode.share_explains > kShareMayExplain;
}

/// Whether it is what a torque sensor makes whose zero has moved.
bool is_lasting_offset(const RelationEpisode& episode) {
  return episode.kind == RelationKind::actuator && episode.offset_explains > kConstant &&
         episode.end_s - episode.onset_s >= kStays_s;
}

/// What the motion says that the drive's second residual seconds.
bool seconds(const RelationEpisode& episode, const FaultLabel& motion) {
  if (motion.joint != episode.joint + 1) return false;
  return (loses_torque(motion.kind) && gave_less(episode)) ||
         (motion.kind == FaultKind::torque_sensor_error && is_lasting_offset(episode));
}

/// The motion's word on the same thing becomes evidence; where both say lost torque, or a sensor that is off,
/// its name stays.
void take_over(FaultFinding& finding, const FaultFinding& motion, const RelationEpisode& episode) {
  if (seconds(episode, motion.label) && motion.decided_by != DecidedBy::criterion) {
    finding.label = motion.label;
    finding.extent = motion.extent;
    finding.next_check = motion.next_check;
  }
  if (finding.trace.time.empty()) {
    finding.mlp = motion.mlp;
    finding.rbfn = motion.rbfn;
    finding.episode = motion.episode;
    finding.trace = motion.trace;
  }
  finding.onset_s = std::min(finding.onset_s, std::max(motion.onset_s, finding.onset_s - kSameTime_s));
  finding.alarm_s = std::min(finding.alarm_s, motion.alarm_s);
  finding.evidence.push_back(
      {"motion", motion.onset_s, "s",
       fmt::format("the motion shows it too (it alone says {})", label_text(motion.label, " at joint "))});
  if (motion.label != finding.label)
    finding.could_also_be.push_back({motion.label, "what the motion alone says"});
}

}  // namespace

std::vector<EvidenceItem> limit_evidence(const RelationEpisode& episode) {
  return {
      {"times_limit", episode.times_limit, "", "largest mean over what healthy logs reach"},
      {"log_likelihood_ratio", episode.nats, "nats", "log likelihood ratio against no difference"},
  };
}

double confidence_of(const RelationEpisode& episode) {
  return episode.times_limit > kWellBeyond ? kSure : kLess;
}

FaultFinding finding_of(const RelationEpisode& episode, const Chain& chain) {
  FaultFinding finding;
  const bool lost = is_lost_torque(episode);
  finding.label = {lost ? FaultKind::torque_loss : FaultKind::unknown, episode.joint + 1};
  if (lost) finding.extent.size = episode.share;
  finding.onset_s = episode.onset_s;
  finding.alarm_s = episode.alarm_s;
  finding.end_s = episode.end_s;
  finding.confidence = confidence_of(episode);
  finding.decided_by = episode.kind == RelationKind::actuator ? DecidedBy::actuator : DecidedBy::control_law;
  finding.evidence = evidence_of(episode, torque_unit(chain.geometry[episode.joint].kind));
  finding.next_check = lost ? next_check_for(finding.label) : next_check_of(episode);
  return finding;
}

std::vector<FaultFinding> with_relations(std::vector<FaultFinding> motion,
                                         const std::vector<RelationEpisode>& episodes, const Chain& chain) {
  std::vector<FaultFinding> found;
  const std::vector<FaultFinding> by_motion = motion;
  for (const RelationEpisode& episode : episodes) {
    std::vector<FaultFinding> others = found;
    others.insert(others.end(), by_motion.begin(), by_motion.end());
    if (follows_from(episode, others) || answers(episode, episodes)) continue;
    FaultFinding finding = finding_of(episode, chain);
    const auto within = std::stable_partition(
        motion.begin(), motion.end(), [&](const FaultFinding& m) { return !has_same_cause(m, episode); });
    for (auto m = within; m != motion.end(); ++m) take_over(finding, *m, episode);
    if (within == motion.end() && is_lasting_offset(episode))
      finding.could_also_be.push_back(
          {{FaultKind::torque_sensor_error, episode.joint + 1},
           "the difference of both torques stays, and the motion shows nothing of it"});
    motion.erase(within, motion.end());
    found.push_back(std::move(finding));
  }
  motion.insert(motion.end(), std::make_move_iterator(found.begin()), std::make_move_iterator(found.end()));
  return motion;
}

}  // namespace faultline
