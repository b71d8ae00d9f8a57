// SPDX-License-Identifier: MIT
#include "lib/pipeline/diagnose.hpp"

#include <algorithm>
#include <utility>

#include "lib/core/version.hpp"
#include "lib/diagnosis/blind_spots.hpp"
#include "lib/diagnosis/decide_episode.hpp"
#include "lib/diagnosis/finding.hpp"
#include "lib/diagnosis/relation_findings.hpp"
#include "lib/diagnosis/verdict.hpp"
#include "lib/monitor/monitor.hpp"

namespace faultline {

namespace {

/// Those that no hypothesis named.
void add_slow_faults(const std::vector<SlowFault>& slow, const Model& model,
                     std::vector<FaultFinding>& faults) {
  const std::vector<FaultFinding> named = faults;
  for (const SlowFault& fault : slow) {
    FaultFinding finding = finding_of(fault, model.motion.chain);
    if (std::none_of(named.begin(), named.end(),
                     [&](const FaultFinding& other) { return other.label == finding.label; }))
      faults.push_back(std::move(finding));
  }
}

}  // namespace

Diagnosis diagnose(LogSource& log, const Model& model, const CaseBase& cases,
                   const DiagnoseOptions& options) {
  const MonitoredLog run = monitor(log, model, options);
  std::vector<FaultFinding> faults;
  for (const MonitoredEpisode& episode : run.episodes)
    faults.push_back(decide_episode(episode, model, cases));
  for (const SampleAlarm& alarm : run.sample_alarms) faults.push_back(finding_of(alarm));
  add_slow_faults(run.slow_faults, model, faults);
  faults = with_relations(std::move(faults), run.relation_episodes, model.motion.chain);

  Diagnosis diagnosis;
  diagnosis.log = run.log;
  diagnosis.model = {model.name, model.sha256, cases.sha256()};
  diagnosis.program_version = program_version();
  diagnosis.residuals = run.residuals;
  diagnosis.condition = condition_of(run.slow, model.motion.chain);
  diagnosis.cannot_see = blind_spots(model.robot.log.torque, run.log.has_velocity);
  for (std::string& spot : relation_spots(model.relations, run.relations_judged_s))
    diagnosis.cannot_see.push_back(std::move(spot));
  for (std::string& spot : weak_spots(model.validation)) diagnosis.cannot_see.push_back(std::move(spot));
  for (std::string& sentence : reach_sentences(model.validation.reach, model.motion.chain))
    diagnosis.cannot_see.push_back(std::move(sentence));
  settle_verdict(diagnosis, std::move(faults), model.sample_period_s, power_of(model.validation));
  return diagnosis;
}

}  // namespace faultline
