// SPDX-License-Identifier: MIT
#include "lib/pipeline/diagnose.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "lib/core/version.hpp"
#include "lib/diagnosis/decide_episode.hpp"
#include "lib/diagnosis/decision.hpp"
#include "lib/monitor/listen.hpp"
#include "lib/monitor/listen_to_samples.hpp"

namespace faultline {
namespace {

constexpr double kOtherPeriod = 1.3;  // the noise and timing of a model belong to its sample period
constexpr std::int64_t kFewestRows = 20;
constexpr double kFewestJudgeable = 0.2;  // of the rows, below which a log without findings is inconclusive

/// The path as given when it is relative, else its file name: no name of a machine's folders in a report.
std::string shown_path(const std::string& path) {
  const std::filesystem::path given(path);
  return given.is_absolute() ? given.filename().string() : given.generic_string();
}

LogFacts log_facts(const LogSource& log, const LogTally& tally, const LogQuality& quality, int joints) {
  LogFacts facts;
  facts.path = shown_path(log.identity().path);
  facts.sha256 = log.identity().sha256;
  facts.format = log.identity().format;
  facts.rows_read = log.identity().rows_read;
  facts.rows_used = tally.rows;
  facts.start_s = tally.start_s;
  facts.end_s = tally.end_s;
  facts.sample_period_s = quality.time.period_s;
  facts.joints = joints;
  facts.issues = log.issues();
  facts.issues.merge(quality.issues);
  return facts;
}

std::vector<JointResidualSummary> residual_table(const std::vector<JointResidual>& residuals) {
  std::vector<JointResidualSummary> table;
  for (std::size_t j = 0; j < residuals.size(); ++j) {
    const JointResidual& r = residuals[j];
    table.push_back(
        {static_cast<int>(j) + 1, r.velocity_rms, r.velocity_peak, r.velocity_peak_s, r.position_rms});
  }
  return table;
}

/// A fault that stays is one finding, however often the log looks healthy in between (a joint at rest hides
/// most faults): later episodes on the same joint extend it.
void merge_continued(std::vector<FaultFinding>& faults) {
  std::vector<FaultFinding> merged;
  for (FaultFinding& fault : faults) {
    const auto same = std::find_if(merged.begin(), merged.end(), [&](const FaultFinding& earlier) {
      return !describe(earlier.label.kind).passes && earlier.label.joint == fault.label.joint;
    });
    if (same == merged.end()) {
      merged.push_back(std::move(fault));
    } else {
      same->end_s = std::max(same->end_s, fault.end_s);
    }
  }
  faults = std::move(merged);
}

std::vector<std::string> blind_spots(const Model& model, bool has_velocity) {
  std::vector<std::string> spots;
  if (model.robot.log.torque == TorqueMeaning::measured)
    spots.push_back(
        "The logged torque is measured, so a lost or added torque is inside it: free-swinging joints and "
        "torque loss cannot be seen.");
  if (model.robot.log.torque == TorqueMeaning::current)
    spots.push_back(
        "The logged torque is a motor current: faults between controller and motor current cannot be seen.");
  if (!has_velocity)
    spots.push_back("The log has no velocities: small and short faults are seen later or not at all.");
  return spots;
}

/// Why the log cannot be judged with this model; empty when it can.
std::string why_inconclusive(const LogFacts& log, const LogTally& tally, const Model& model) {
  const double ratio = log.sample_period_s / model.sample_period_s;
  if (ratio > kOtherPeriod || ratio < 1.0 / kOtherPeriod)
    return fmt::format(
        "the log has a sample every {:.4g} s, the model was learned from logs with one every {:.4g} s; learn "
        "a model from healthy logs of this rate",
        log.sample_period_s, model.sample_period_s);
  if (tally.rows < kFewestRows)
    return fmt::format("the log has {} usable rows; at least {} are needed to judge", tally.rows,
                       kFewestRows);
  if (static_cast<double>(tally.judgeable_rows) < kFewestJudgeable * static_cast<double>(tally.rows))
    return fmt::format("only {} of {} rows have position and torque of every joint", tally.judgeable_rows,
                       tally.rows);
  return "";
}

void settle_verdict(Diagnosis& diagnosis, const LogTally& tally, const Model& model) {
  diagnosis.verdict_reason = why_inconclusive(diagnosis.log, tally, model);
  if (!diagnosis.verdict_reason.empty()) {
    diagnosis.verdict = Verdict::inconclusive;
    diagnosis.faults.clear();
    return;
  }
  order_faults(diagnosis);
  const std::size_t count = diagnosis.faults.size();
  diagnosis.verdict = count > 0 ? Verdict::faulty : Verdict::healthy;
  diagnosis.verdict_reason = count > 0 ? fmt::format("{} fault{} found", count, count == 1 ? "" : "s")
                                       : "the identified robot explains the whole log";
}

void note_rejected(Issues& issues, int count) {
  if (count > 0)
    issues.add({"short_disturbance", "", Severity::note,
                "a disturbance looked like a fault but did not last (wild values?); it was not reported", 0,
                std::numeric_limits<double>::quiet_NaN(), count, 0});
}

/// What both ways of telling faults have in common.
struct Findings {
  LogTally tally;
  std::vector<JointResidual> residuals;
  std::vector<FaultFinding> faults;
  int rejected_alarms = 0;
};

Findings find_by_evidence(LogSource& log, const Model& model, const CaseBase& cases) {
  const Heard heard = listen(log, model);
  Findings found{heard.tally, heard.residuals, {}, heard.rejected_alarms};
  for (std::size_t i = 0; i < heard.episodes.size(); ++i)
    found.faults.push_back(decide_episode(heard.episodes[i], heard.episode_residuals[i], model, cases));
  merge_continued(found.faults);
  return found;
}

Findings find_by_samples(LogSource& log, const Model& model, const DiagnoseOptions& options) {
  CriterionOptions criterion =
      options.criterion == CriterionKind::consecutive ? model.samples.consecutive : model.samples.log_odds;
  if (options.g > 0) criterion.g = options.g;
  HeardSamples heard = listen_to_samples(log, model, criterion);
  return {heard.tally, heard.residuals, std::move(heard.faults), 0};
}

}  // namespace

Diagnosis diagnose(LogSource& log, const Model& model, const CaseBase& cases,
                   const DiagnoseOptions& options) {
  Findings found = options.mode == ClassifyMode::evidence ? find_by_evidence(log, model, cases)
                                                          : find_by_samples(log, model, options);
  Diagnosis diagnosis;
  diagnosis.log = log_facts(log, found.tally, quality_of(found.tally.quality), model.robot.joints());
  note_rejected(diagnosis.log.issues, found.rejected_alarms);
  diagnosis.model = {model.name, model.sha256, cases.sha256()};
  diagnosis.program_version = program_version();
  diagnosis.residuals = residual_table(found.residuals);
  diagnosis.faults = std::move(found.faults);
  diagnosis.cannot_see = blind_spots(model, found.tally.has_velocity);
  settle_verdict(diagnosis, found.tally, model);
  return diagnosis;
}

}  // namespace faultline
