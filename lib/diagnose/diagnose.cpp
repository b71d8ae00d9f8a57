// SPDX-License-Identifier: MIT
#include "lib/diagnose/diagnose.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "lib/core/issue.hpp"
#include "lib/core/version.hpp"
#include "lib/diagnose/blind_spots.hpp"
#include "lib/diagnose/decide_episode.hpp"
#include "lib/diagnose/finding.hpp"
#include "lib/diagnose/least_size.hpp"
#include "lib/diagnose/monitor/model_rate.hpp"
#include "lib/diagnose/monitor/monitor.hpp"
#include "lib/diagnose/question/check_interpretation.hpp"
#include "lib/diagnose/relation_findings.hpp"
#include "lib/diagnose/stop/explain_stop.hpp"
#include "lib/diagnose/verdict.hpp"
#include "lib/log/recorder/corrected_source.hpp"
#include "lib/model/model_files.hpp"

namespace faultline {

namespace {

constexpr double kLittleLeft = 0.02;  // residual, share of the excess over the noise: columns are not tested

/// Adds lasting friction at joints without another finding.
void add_lasting_friction(const MonitoredLog& run, const Model& model, std::vector<FaultFinding>& faults) {
  const std::vector<FaultFinding> named = faults;
  for (const DayEffect& friction : lasting_friction(run.day))
    if (std::none_of(named.begin(), named.end(),
                     [&](const FaultFinding& other) { return other.label.joint == friction.joint; }))
      faults.push_back(finding_of(friction, run.log, model.robot.chain));
}

/// What a log shows, and what it cannot show.
struct LogFindings {
  std::vector<FaultFinding> faults;
  std::vector<std::string> cannot_see;
};

/// Returns what positions and velocities against their references show of a log without torque.
LogFindings found_by_tracking(const MonitoredLog& run, const Model& model) {
  LogFindings out{tracking_findings(run.relation_episodes, model.robot.chain), unjudged_spots(run.log)};
  for (std::string& spot : tracking_spots(model, run.relations_judged_s))
    out.cannot_see.push_back(std::move(spot));
  return out;
}

/// Returns what torque balance, single samples and other signals show of a log.
LogFindings found_by_torque(const MonitoredLog& run, const Model& model, const CaseBase& cases) {
  LogFindings out;
  for (const MonitoredEpisode& episode : run.episodes)
    out.faults.push_back(decide_episode(episode, model, cases));
  for (const SampleAlarm& alarm : run.sample_alarms) out.faults.push_back(finding_of(alarm));
  add_lasting_friction(run, model, out.faults);
  for (const JudgedStretch& judged : run.stretches)
    out.faults.push_back(finding_of(run.relation_episodes[judged.stretch.id], judged, run.log.end_s, model));
  for (auto& more :
       {unjudged_spots(run.log), resting_spots(run.log), torque_limit_spots(run.log, model.robot),
        blind_spots(model.robot.log.torque, run.log.has_velocity),
        relation_spots(model.relations, run.relations_judged_s),
        drive_limit_spots(model.relations, run.relations_beyond_s, model.robot.chain),
        weak_spots(model.validation), rough_spots(run.roughness),
        detectability_sentences(model.validation.reach, model.robot.chain), least_size_sentences(model)})
    out.cannot_see.insert(out.cannot_see.end(), more.begin(), more.end());
  return out;
}

void note_mismatch(const LogMismatch& doubt, Issues& issues) {
  issues.add(make_issue(
      kMisreadLog, Severity::severe,
      fmt::format("the log does not match this model; it looks as if {}; {}{}", doubt.what, doubt.cure,
                  doubt.is_entry_of_columns
                      ? " of a robot file for this log and convert it: faultline convert LOG OUT --robot"
                      : "")));
}

/// Whether a misfit between log and robot is held against the log: not if the robot did not even explain the
/// logs that it was learned from.
bool can_check_columns(const Model& model) {
  return model.has_mechanics() && model.identification.status != IdentificationStatus::unexplained;
}

/// Returns the rows to judge: those of the log, or of the log at the model's rate, which `kept` then owns.
/// The meaning of the columns is tested once the rate is settled. Adds a severe issue with the likely cause
/// when the log contradicts the model from the start (wrong unit, sign, columns, clock or robot).
LogSource& settle_log(LogSource& log, const LogRate& rate, const Model& model, Issues& issues,
                      std::unique_ptr<LogSource>& kept) {
  if (!rate.is_models()) {
    const LogMismatch clock = can_check_columns(model)
                                  ? check_clock(log, {model.robot, model.motion}, model.sample_period_s)
                                  : LogMismatch{};
    if (!clock.is_empty()) note_mismatch(clock, issues);
    if (!clock.is_empty() || !rate.can_be_resampled()) return log;
    issues.add(resampled_issue(rate, model));
  }
  LogSource& judged = judged_rows(log, model, issues, kept);
  if (!can_check_columns(model)) return judged;
  if (const LogMismatch doubt = check_interpretation(judged, {model.robot, model.motion}); !doubt.is_empty())
    note_mismatch(doubt, issues);
  return judged;
}

/// Returns the faults with the run in which each began, and its clock offset, if the log has several runs.
std::vector<FaultFinding> with_runs(std::vector<FaultFinding> faults, const std::vector<LogRun>& runs) {
  if (runs.size() < 2) return faults;
  for (FaultFinding& fault : faults)
    for (const LogRun& run : runs)
      if (run.is_read && (fault.run == 0 || run.start_s <= fault.onset_s)) {
        fault.run = run.run;
        fault.clock_offset_s = run.clock_offset_s;
      }
  return faults;
}

/// Returns the faults, each ended with the run in which it began: if the next run shows it, it is found there
/// again.
std::vector<FaultFinding> ended_with_run(std::vector<FaultFinding> faults, const std::vector<LogRun>& runs) {
  for (FaultFinding& fault : faults)
    for (const LogRun& run : runs)
      if (run.is_read && run.start_s <= fault.onset_s && fault.onset_s <= run.end_s)
        fault.end_s = std::min(fault.end_s, run.end_s);
  return faults;
}

/// Whether faults of known kinds explain nearly all of a log's excess over the noise, or as much as a torque
/// of any form does. A change of columns resembles no kind except a free-swinging joint, which a torque in a
/// smaller unit looks like.
bool are_explained(const std::vector<MonitoredEpisode>& episodes) {
  return !episodes.empty() &&
         std::all_of(episodes.begin(), episodes.end(), [](const MonitoredEpisode& episode) {
           const FaultKind kind = episode.fault.claim.kind;
           return kind != FaultKind::unknown && kind != FaultKind::free_swinging &&
                  (episode.fault.residual_share < kLittleLeft || episode.fault.misfit <= 0.0);
         });
}

/// Adds a severe issue if the first fault may be a change of the log's columns. `has_log_rows`: the rows of
/// `judged` are those of the log, not resampled.
void check_column_change(LogSource& judged, bool has_log_rows, const Model& model,
                         const std::vector<FaultFinding>& faults, Issues& issues) {
  if (faults.empty() || issues.find(kMisreadLog)) return;
  double onset_s = std::numeric_limits<double>::infinity();
  for (const FaultFinding& fault : faults)
    if (fault.onset_s < onset_s) onset_s = fault.onset_s;
  const std::optional<ColumnChange> change = find_column_change(judged, {model.robot, model.motion}, onset_s);
  if (!change) return;
  const std::int64_t row = has_log_rows ? change->row : 0;
  issues.add({kChangedColumns, "", Severity::severe,
              fmt::format("{}from about {:.4g} s on the log looks as if {}, and before it does not; cut the "
                          "log there, or correct the columns",
                          row > 0 ? fmt::format("row {}: ", row) : "", change->at_s, change->what),
              row, change->at_s, 1});
}

}  // namespace

Diagnosis diagnose(LogSource& log, const Model& model, const CaseBase& cases,
                   const DiagnoseOptions& options) {
  Issues doubts;
  std::unique_ptr<LogSource> kept;
  const LogRate rate = log_rate(log, model);
  LogSource& judged = settle_log(log, rate, model, doubts, kept);
  const bool can_be_judged = rate.is_models() || doubts.find(kResampled);
  const MonitoredLog run = can_be_judged ? monitor(judged, model, options) : read_unjudged(log, model);
  LogFindings found = run.log.is_tracked ? found_by_tracking(run, model) : found_by_torque(run, model, cases);
  if (can_check_columns(model) && !run.log.is_tracked && !are_explained(run.episodes))
    check_column_change(judged, &judged == &log, model, found.faults, doubts);
  const std::vector<FaultFinding> faults = ended_with_run(std::move(found.faults), run.log.runs);
  Diagnosis diagnosis;
  diagnosis.log = run.log;
  diagnosis.log.issues.merge(doubts);
  diagnosis.model = {model.name, model.sha256, cases.sha256(), notes_of(model), model.grave_doubts};
  diagnosis.program_version = program_version();
  diagnosis.residuals = run.residuals;
  diagnosis.condition = condition_of(run.day, model.robot.chain);
  diagnosis.roughness = run.roughness;
  diagnosis.judged_share = run.judged_share;
  diagnosis.score = run.score;
  diagnosis.cannot_see = std::move(found.cannot_see);
  diagnosis = with_verdict(std::move(diagnosis), faults, model.sample_period_s, power_of(model.validation));
  if (diagnosis.log.issues.find(kResampled)) diagnosis.log.sample_period_s = rate.period_s;
  diagnosis.faults = with_runs(std::move(diagnosis.faults), diagnosis.log.runs);
  if (options.stop) diagnosis.stop = explain_stop(judged, model, cases, options, diagnosis);
  return diagnosis;
}

}  // namespace faultline
