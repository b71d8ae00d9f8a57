// SPDX-License-Identifier: MIT
#include "lib/pipeline/twin_study.hpp"

#include <algorithm>
#include <map>
#include <mutex>

#include "lib/core/parallel.hpp"
#include "lib/diagnosis/decide_episode.hpp"
#include "lib/log/memory_source.hpp"

namespace faultline {
namespace {

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

bool alarmed_early(const HeardRun& run) {
  return std::any_of(run.heard.episodes.begin(), run.heard.episodes.end(),
                     [&](const EpisodeEvidence& episode) { return episode.alarm_s < run.onset_s; });
}

void count(const HeardRun& run, int episode, const FaultFinding& finding, ValidationRow& row,
           std::vector<double>& delays) {
  ++row.detected;
  const bool kind = finding.label.kind == run.label.kind, joint = finding.label.joint == run.label.joint;
  const bool named = std::any_of(finding.could_also_be.begin(), finding.could_also_be.end(),
                                 [&](const Alternative& other) { return other.label == run.label; });
  row.right_kind += kind;
  row.right_joint += joint;
  row.right_kind_and_joint += kind && joint;
  row.right_or_named += (kind && joint) || named;
  delays.push_back(run.heard.episodes[episode].alarm_s - run.onset_s);
}

}  // namespace

std::vector<HeardRun> hear_twin_runs(const Twin& twin, const Model& model,
                                     const std::vector<FaultLabel>& labels, std::uint64_t first_seed,
                                     int threads, const Progress& progress) {
  std::vector<HeardRun> runs(labels.size());
  std::mutex reporting;
  int done = 0;
  parallel_for(static_cast<int>(labels.size()), threads, [&](int i) {
    TwinRun run = twin_run(twin, labels[i], first_seed + static_cast<std::uint64_t>(i));
    runs[i].label = run.label;
    runs[i].onset_s = run.onset_s;
    runs[i].length_s = run.log.rows() > 0 ? run.log.time.back() - run.log.time.front() : 0.0;
    MemorySource source(std::move(run.log), "simulated");
    runs[i].heard = listen(source, model);
    const std::lock_guard lock(reporting);
    if (progress)
      progress("simulating faults", static_cast<double>(++done) / static_cast<double>(labels.size()));
  });
  return runs;
}

int episode_of_fault(const HeardRun& run) {
  for (std::size_t i = 0; i < run.heard.episodes.size(); ++i)
    if (run.heard.episodes[i].alarm_s >= run.onset_s) return static_cast<int>(i);
  return -1;
}

Validation validate(const std::vector<HeardRun>& faulty, const std::vector<HeardRun>& healthy,
                    const Model& model, const CaseBase& cases) {
  Validation validation;
  std::map<FaultKind, ValidationRow> rows;
  std::map<FaultKind, std::vector<double>> delays;
  for (const HeardRun& run : faulty) {
    ValidationRow& row = rows[run.label.kind];
    row.kind = run.label.kind;
    ++row.runs;
    validation.early_alarms += alarmed_early(run);
    const int i = episode_of_fault(run);
    if (i < 0) continue;
    const FaultFinding finding =
        decide_episode(run.heard.episodes[i], run.heard.episode_residuals[i], model, cases);
    count(run, i, finding, row, delays[run.label.kind]);
  }
  for (auto& [kind, row] : rows) {
    row.median_delay_s = quantile(delays[kind], 0.5);
    row.p90_delay_s = quantile(delays[kind], 0.9);
    validation.rows.push_back(row);
  }
  for (const HeardRun& run : healthy) {
    validation.healthy_hours += run.length_s / 3600.0;
    validation.false_alarms += static_cast<int>(run.heard.episodes.size());
  }
  return validation;
}

}  // namespace faultline
