// SPDX-License-Identifier: MIT
#include "lib/pipeline/diagnose.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "lib/core/version.hpp"
#include "lib/diagnosis/decision.hpp"
#include "lib/pipeline/decide_episode.hpp"
#include "lib/pipeline/listen.hpp"

namespace faultline {
namespace {

constexpr std::int64_t kFewestRows = 20;
constexpr double kFewestJudgeable = 0.2;  // of the rows, below which a log without findings is inconclusive

/// The path as given when it is relative, else its file name: no name of a machine's folders in a report.
std::string shown_path(const std::string& path) {
  const std::filesystem::path given(path);
  return given.is_absolute() ? given.filename().string() : given.generic_string();
}

LogFacts log_facts(const LogSource& log, const Heard& heard, int joints) {
  LogFacts facts;
  facts.path = shown_path(log.identity().path);
  facts.sha256 = log.identity().sha256;
  facts.format = log.identity().format;
  facts.rows_read = log.identity().rows_read;
  facts.rows_used = heard.rows;
  facts.start_s = heard.start_s;
  facts.end_s = heard.end_s;
  if (heard.rows > 1)
    facts.sample_period_s = (heard.end_s - heard.start_s) / static_cast<double>(heard.rows - 1);
  facts.joints = joints;
  facts.issues = log.issues();
  if (heard.rejected_alarms > 0)
    facts.issues.add(
        {"short_disturbance", "", Severity::note,
         "a disturbance looked like a fault but did not last (wild values?); it was not reported", 0,
         std::numeric_limits<double>::quiet_NaN(), heard.rejected_alarms, 0});
  return facts;
}

std::vector<JointResidualSummary> residual_table(const Heard& heard) {
  std::vector<JointResidualSummary> table;
  for (std::size_t j = 0; j < heard.residuals.size(); ++j) {
    const JointResidual& r = heard.residuals[j];
    table.push_back(
        {static_cast<int>(j) + 1, r.velocity_rms, r.velocity_peak, r.velocity_peak_s, r.position_rms});
  }
  return table;
}

bool passes(FaultKind kind) { return kind == FaultKind::collision; }

/// A fault that stays is one finding, however often the log looks healthy in between (a joint at rest hides
/// most faults): later episodes on the same joint extend it.
void merge_continued(std::vector<FaultFinding>& faults) {
  std::vector<FaultFinding> merged;
  for (FaultFinding& fault : faults) {
    const auto same = std::find_if(merged.begin(), merged.end(), [&](const FaultFinding& earlier) {
      return !passes(earlier.label.kind) && earlier.label.joint == fault.label.joint;
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
        "torque loss "
        "cannot be seen.");
  if (model.robot.log.torque == TorqueMeaning::current)
    spots.push_back(
        "The logged torque is a motor current: faults between controller and motor current cannot be seen.");
  if (!has_velocity)
    spots.push_back("The log has no velocities: small and short faults are seen later or not at all.");
  return spots;
}

void settle_verdict(Diagnosis& diagnosis, const Heard& heard) {
  order_faults(diagnosis);
  if (!diagnosis.faults.empty()) {
    diagnosis.verdict = Verdict::faulty;
    diagnosis.verdict_reason =
        fmt::format("{} fault{} found", diagnosis.faults.size(), diagnosis.faults.size() == 1 ? "" : "s");
    return;
  }
  const double judgeable =
      heard.rows > 0 ? static_cast<double>(heard.judgeable_rows) / static_cast<double>(heard.rows) : 0.0;
  diagnosis.verdict =
      judgeable < kFewestJudgeable || heard.rows < kFewestRows ? Verdict::inconclusive : Verdict::healthy;
  diagnosis.verdict_reason = diagnosis.verdict == Verdict::healthy
                                 ? "the identified robot explains the whole log"
                                 : fmt::format(
                                       "only {} of {} rows have position and torque of every joint; at least "
                                       "{} rows are needed to judge",
                                       heard.judgeable_rows, heard.rows, kFewestRows);
}

}  // namespace

Diagnosis diagnose(LogSource& log, const Model& model, const CaseBase& cases) {
  const Heard heard = listen(log, model);
  Diagnosis diagnosis;
  diagnosis.log = log_facts(log, heard, model.robot.joints());
  diagnosis.model = {model.name, model.sha256, cases.sha256()};
  diagnosis.program_version = program_version();
  diagnosis.residuals = residual_table(heard);
  for (std::size_t i = 0; i < heard.episodes.size(); ++i)
    diagnosis.faults.push_back(decide_episode(heard.episodes[i], heard.episode_residuals[i], model, cases));
  merge_continued(diagnosis.faults);
  diagnosis.cannot_see = blind_spots(model, heard.has_velocity);
  settle_verdict(diagnosis, heard);
  return diagnosis;
}

}  // namespace faultline
