// SPDX-License-Identifier: MIT
#include "lib/monitor/monitor.hpp"

#include <limits>
#include <utility>

#include "lib/evidence/survey/survey_log.hpp"
#include "lib/log/transformed/delayed_torque_source.hpp"
#include "lib/log/transformed/empty_rows_source.hpp"
#include "lib/log/transformed/tapped_source.hpp"
#include "lib/monitor/evidence_monitor.hpp"
#include "lib/monitor/log_tally.hpp"
#include "lib/monitor/relation_monitor.hpp"
#include "lib/monitor/sample_monitor.hpp"
#include "lib/residual/residuals.hpp"

namespace faultline {
namespace {

/// Whether there is no torque that the model could judge. Rewinds the log before and after. Throws
/// Error(input) for a log of another number of joints, before anything takes it for the model's.
bool lacks_torque(LogSource& log, const Model& model) {
  if (!model.has_mechanics()) return true;
  log.rewind();
  Log first;
  const bool has_rows = log.next(first);
  if (has_rows) check_joints(first, log, model);
  const bool lacks = has_rows && first.tau.empty();
  log.rewind();
  return lacks;
}

MonitoredLog monitor_tracking(LogSource& log, const Model& model) {
  RelationMonitor relations(model.relations, true);
  LogTally tally;
  for (Log segment; log.next(segment);) {
    tally.take(segment, log, model);
    tally.thin.take(segment, log.identity().runs);
    relations.take(segment);
  }
  relations.finish();
  MonitoredLog out;
  out.log = log_facts(log, tally, model);
  out.log.is_tracked = true;
  out.relation_episodes = relations.episodes();
  out.relations_judged_s = relations.judged_s();
  return out;
}

MonitoredLog monitor(LogSource& log, const Model& model, const DiagnoseOptions& options,
                     double enough_from_s) {
  if (lacks_torque(log, model)) return monitor_tracking(log, model);
  const bool by_samples = options.mode == ClassifyMode::samples;
  EmptyRowsSource surveyed(log);
  LogDay day = by_samples ? LogDay{} : survey_log(surveyed, model.motion);
  day.noise.repeats_say_nothing = model.has_velocity && !day.noise.has_velocity;
  EvidenceMonitor evidence(model, by_samples ? model.motion : day.model, day.noise);
  SampleMonitor samples(model.samples, options);
  const std::vector<SignalRelation> none;
  RelationMonitor relations(by_samples ? none : model.relations, false);
  LogTally tally;
  TappedSource counted(log, [&](const Log& segment) { tally.take(segment, log, model); });
  EmptyRowsSource filled(counted);
  TappedSource watched(filled, [&](const Log& segment) {
    tally.thin.take(segment, log.identity().runs);
    relations.take(segment);
  });
  DelayedTorqueSource in_time(watched, day.torque_delay_s);
  LogSource& acting = day.torque_delay_s.empty() ? static_cast<LogSource&>(watched) : in_time;
  ResidualState state;
  ResidualSummary whole;
  for (Log segment; acting.next(segment);) {
    Residuals residuals = compute_residuals(model.residual, segment, state);
    whole.add(residuals);
    if (by_samples)
      samples.take(residuals);
    else
      evidence.take(segment, std::move(residuals));
    if (evidence.has_alarmed_since(enough_from_s)) break;
  }
  evidence.finish();
  samples.finish();
  relations.finish();
  LogFacts facts = log_facts(log, tally, model, evidence.rejected_alarms());
  facts.issues.merge(day.notes);
  facts.is_whole = facts.is_whole && filled.rows_put_in() == 0;
  return {std::move(facts),       whole.joints(),           evidence.episodes(),
          samples.alarms(),       evidence.largest_ratio(), evidence.slow_estimates(),
          evidence.slow_faults(), relations.episodes(),     relations.judged_s(),
          relations.beyond_s(),   std::move(day.roughness)};
}

}  // namespace

MonitoredLog monitor(LogSource& log, const Model& model, const DiagnoseOptions& options) {
  return monitor(log, model, options, std::numeric_limits<double>::infinity());
}

MonitoredLog read_unjudged(LogSource& log, const Model& model) {
  LogTally tally;
  log.rewind();
  for (Log segment; log.next(segment);) {
    tally.take(segment, log, model);
    tally.thin.take(segment, log.identity().runs);
  }
  MonitoredLog out;
  out.log = log_facts(log, tally, model);
  return out;
}

MonitoredLog monitor_until_found(LogSource& log, const Model& model, double enough_from_s) {
  return monitor(log, model, {}, enough_from_s);
}

}  // namespace faultline
