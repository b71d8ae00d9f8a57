// SPDX-License-Identifier: MIT
#include "lib/diagnose/finding.hpp"

#include <fmt/format.h>

#include "lib/core/number_text.hpp"
#include "lib/diagnose/alternatives.hpp"
#include "lib/diagnose/finding_evidence.hpp"
#include "lib/diagnose/least_size.hpp"
#include "lib/fault/fault_words.hpp"

namespace faultline {
namespace {

constexpr double kSureOfFriction = 0.95;  // its interval alone leaves less, other kinds leave more

EpisodeFacts facts_of(const Episode& episode, const std::vector<std::string>& feature_names) {
  EpisodeFacts facts;
  facts.evidence = episode.evidence;
  for (std::size_t i = 0; i < std::min(feature_names.size(), episode.features.size()); ++i)
    facts.features.emplace_back(feature_names[i], episode.features[i]);
  return facts;
}

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

FaultFinding finding_of(const LastingFriction& fault, const Chain<double>& chain) {
  const ConditionItem item = condition_of({fault.effect}, chain).front();
  FaultFinding finding;
  finding.label = {FaultKind::friction_increase, item.joint};
  finding.onset_s = fault.start_s;
  finding.alarm_s = fault.end_s;
  finding.end_s = fault.end_s;
  finding.confidence = kSureOfFriction;
  finding.decided_by = DecidedBy::evidence;
  finding.evidence = {
      {item.name, item.value, item.unit,
       fmt::format("{} against the robot that was identified ({} to {} {} with 95 %, normal within {} {}), "
                   "from the first row on",
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

}  // namespace faultline
