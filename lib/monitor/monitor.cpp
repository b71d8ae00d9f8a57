// SPDX-License-Identifier: MIT
#include "lib/monitor/monitor.hpp"

#include "lib/evidence/survey/survey_log.hpp"
#include "lib/log/transformed/delayed_torque_source.hpp"
#include "lib/monitor/evidence_monitor.hpp"
#include "lib/monitor/log_tally.hpp"
#include "lib/monitor/relation_monitor.hpp"
#include "lib/monitor/sample_monitor.hpp"
#include "lib/residual/residuals.hpp"

namespace faultline {

MonitoredLog monitor(LogSource& log, const Model& model, const DiagnoseOptions& options) {
  const bool by_samples = options.mode == ClassifyMode::samples;
  LogDay day = by_samples ? LogDay{} : survey_log(log, model.motion);
  day.noise.repeats_say_nothing = model.has_velocity && !day.noise.has_velocity;
  EvidenceMonitor evidence(model, by_samples ? model.motion : day.model, day.noise);
  SampleMonitor samples(model.samples, options);
  const std::vector<SignalRelation> none;
  RelationMonitor relations(by_samples ? none : model.relations);
  WatchedSource watched(log, relations);
  DelayedTorqueSource in_time(watched, day.torque_delay_s);
  LogSource& acting = day.torque_delay_s.empty() ? static_cast<LogSource&>(watched) : in_time;
  LogTally tally;
  ResidualState state;
  ResidualSummary whole;
  for (Log segment; acting.next(segment);) {
    tally.take(segment, log, model);
    Residuals residuals = compute_residuals(model.residual, segment, state);
    whole.add(residuals);
    if (by_samples)
      samples.take(residuals);
    else
      evidence.take(segment, std::move(residuals));
  }
  evidence.finish();
  samples.finish();
  relations.finish();
  LogFacts facts = log_facts(log, tally, model, evidence.rejected_alarms());
  facts.issues.merge(day.notes);
  return {std::move(facts),       whole.joints(),           evidence.episodes(),
          samples.alarms(),       evidence.largest_ratio(), evidence.slow_estimates(),
          evidence.slow_faults(), relations.episodes(),     relations.judged_s()};
}

}  // namespace faultline
