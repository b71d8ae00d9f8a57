// SPDX-License-Identifier: MIT
#include "lib/diagnose/monitor/monitor.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "lib/diagnose/monitor/explain_monitor.hpp"
#include "lib/diagnose/monitor/log_tally.hpp"
#include "lib/diagnose/monitor/relation_monitor.hpp"
#include "lib/diagnose/monitor/sample_monitor.hpp"
#include "lib/explain/explain_at.hpp"
#include "lib/log/transformed/empty_rows_source.hpp"
#include "lib/log/transformed/tapped_source.hpp"
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

}  // namespace

MonitoredLog monitor(LogSource& log, const Model& model, const DiagnoseOptions& options) {
  if (lacks_torque(log, model)) return monitor_tracking(log, model);
  const bool by_samples = options.mode == ClassifyMode::samples;
  ExplainMonitor explained(model);
  SampleMonitor samples(model.samples, options);
  const std::vector<SignalRelation> none;
  RelationMonitor relations(by_samples ? none : model.relations, false);
  LogTally tally;
  TappedSource counted(log, [&](const Log& segment) { tally.take(segment, log, model); });
  EmptyRowsSource filled(counted);
  ResidualState state;
  ResidualSummary whole;
  for (Log segment; filled.next(segment);) {
    tally.thin.take(segment, log.identity().runs);
    relations.take(segment);
    Residuals residuals = compute_residuals(model.residual, segment, state);
    whole.add(residuals);
    if (by_samples)
      samples.take(residuals);
    else
      explained.take(segment, std::move(residuals), log.identity().runs);
  }
  explained.finish();
  samples.finish();
  relations.finish();
  LogFacts facts = log_facts(log, tally, model);
  facts.is_whole = facts.is_whole && filled.rows_put_in() == 0;
  return {.log = std::move(facts),
          .residuals = whole.joints(),
          .episodes = explained.episodes(),
          .sample_alarms = samples.alarms(),
          .day = explained.day(),
          .relation_episodes = relations.episodes(),
          .relations_judged_s = relations.judged_s(),
          .relations_beyond_s = relations.beyond_s(),
          .roughness = explained.loudness(),
          .judged_share = by_samples ? 1.0 : explained.judged_share()};
}

MonitoredLog monitor_at(LogSource& log, const Model& model, double onset_s, double end_s) {
  const UniformLog uniform = uniform_log(log, model.sample_period_s);
  MonitoredLog out;
  if (!can_explain(uniform, model.explain.robot)) return out;
  std::optional<ExplainedFault> fault = explain_at(uniform, model.explain, onset_s, end_s);
  if (!fault) return out;
  ResidualState state;
  ResidualSummary summary(onset_s, onset_s + kEpisodeResiduals_s);
  log.rewind();
  for (Log segment; log.next(segment);) summary.add(compute_residuals(model.residual, segment, state));
  const double until_s = std::min(fault->claim.end_s, uniform.time_s(uniform.rows() - 1));
  out.episodes.push_back({std::move(*fault), until_s, summary.joints()});
  return out;
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

}  // namespace faultline
