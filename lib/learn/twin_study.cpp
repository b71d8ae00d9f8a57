// SPDX-License-Identifier: MIT
#include "lib/learn/twin_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "lib/core/error.hpp"
#include "lib/core/parallel.hpp"
#include "lib/core/statistics.hpp"
#include "lib/diagnose/decide_episode.hpp"
#include "lib/diagnose/monitor/monitor.hpp"
#include "lib/log/log_source.hpp"
#include "lib/residual/residuals.hpp"

namespace faultline {
namespace {

constexpr double kSurely = 0.9;  // share of the logs in which a size must be found

bool alarmed_early(const MonitoredRun& run) {
  return std::any_of(run.log.episodes.begin(), run.log.episodes.end(),
                     [&](const MonitoredEpisode& episode) { return episode.alarm_s() < run.onset_s; });
}

void count(const MonitoredRun& run, double alarm_s, const FaultFinding& finding, ValidationRow& row,
           std::vector<double>& delays) {
  ++row.detected;
  const bool kind = finding.label.kind == run.label.kind, joint = finding.label.joint == run.label.joint;
  const bool named = std::any_of(finding.could_also_be.begin(), finding.could_also_be.end(),
                                 [&](const Alternative& other) { return other.label == run.label; });
  row.right_kind += kind;
  row.right_joint += joint;
  row.right_kind_and_joint += kind && joint;
  row.right_or_named += (kind && joint) || named;
  delays.push_back(alarm_s - run.onset_s);
}

double size_of(const TwinRun& run) {
  const FaultDescription& fault = describe(run.label.kind);
  if (fault.size_count == 0) return std::numeric_limits<double>::quiet_NaN();
  return fault.passes ? run.size * (run.end_s - run.onset_s) : run.size;
}

LabelledResiduals labelled_residuals(const TwinRun& run, const ResidualGenerator& generator) {
  ResidualState state;
  LabelledResiduals out;
  out.residuals = compute_residuals(generator, run.log, state);
  if (run.label.kind == FaultKind::none) return out;
  out.fault = run.label;
  out.onset_s = run.onset_s;
  out.end_s = run.end_s;
  return out;
}

Error runs_diverge(double period_s) {
  return {
      ErrorCode::input, "the healthy logs",
      fmt::format("simulated runs of the identified robot diverge within a few sample periods of {:.3g} s: "
                  "the motion between samples is not determined. Give logs with slower moves or a shorter "
                  "sample period",
                  period_s)};
}

/// Smallest size of a label that is found in nine of ten logs; NaN if there is none.
double detectable_size(const FaultLabel& label, const std::vector<std::vector<LeastFound>>& by_log) {
  std::vector<double> sizes;
  for (const std::vector<LeastFound>& log : by_log)
    for (const LeastFound& each : log)
      if (each.label == label) sizes.push_back(each.size);
  const double size = upper_quantile(std::move(sizes), kSurely);
  return std::isfinite(size) ? size : std::numeric_limits<double>::quiet_NaN();
}

Detectability detectability_of(const FaultLabel& label, std::span<const MonitoredRun> runs,
                               const std::vector<std::vector<LeastFound>>& by_log) {
  Detectability reach{.label = label};
  std::vector<double> sizes;
  std::vector<double> delays;
  for (const MonitoredRun& run : runs) {
    if (run.label != label) continue;
    const MonitoredEpisode* episode = episode_of_fault(run);
    ++reach.runs;
    if (episode) {
      ++reach.found;
      delays.push_back(episode->alarm_s() - run.onset_s);
    }
    if (std::isfinite(run.size)) sizes.push_back(std::abs(run.size));
  }
  reach.median_delay_s = lower_quantile(delays, 0.5);
  if (sizes.empty()) return reach;
  reach.size = detectable_size(label, by_log);
  reach.least_size = *std::min_element(sizes.begin(), sizes.end());
  return reach;
}

}  // namespace

Model with_rigid_gears(Model model) {
  if (auto* rows = std::get_if<BalanceModel>(&model.explain.robot)) {
    rows->theta.segment(rows->layout().spring(0), rows->joints()).setZero();
    rows->setting.compliance.setZero();
  }
  return model;
}

TwinStudy monitored_twin_runs(const Twin& twin, const Model& model, const std::vector<FaultLabel>& labels,
                              const TwinStudyOptions& options, const Progress& progress) {
  const Model rigid = with_rigid_gears(model);
  TwinStudy study;
  study.runs.resize(labels.size());
  if (options.keep_residuals) study.residuals.resize(labels.size());
  const auto count = static_cast<int>(labels.size());
  parallel_steps("simulating faults", count, options.threads, progress, [&](int i) {
    TwinRun run = twin_run(twin, labels[i], options.first_seed + static_cast<std::uint64_t>(i));
    if (run.log.rows() < 2) throw runs_diverge(twin.sample_period_s);
    MonitoredRun& out = study.runs[i];
    out.label = run.label;
    out.onset_s = run.onset_s;
    out.length_s = run.log.rows() > 0 ? run.log.time.back() - run.log.time.front() : 0.0;
    out.origin = kSimulatedOrigin;
    out.size = size_of(run);
    if (options.keep_residuals) study.residuals[i] = labelled_residuals(run, model.residual);
    MemorySource source(std::move(run.log), "simulated", 64);
    out.log =
        options.at_known_times ? monitor_at(source, rigid, run.onset_s, run.end_s) : monitor(source, rigid);
  });
  return study;
}

std::vector<FaultLabel> labels_to_simulate(const std::vector<FaultLabel>& labels, int count,
                                           const std::vector<FaultKind>& kinds) {
  std::vector<FaultLabel> out;
  for (const FaultLabel& label : labels)
    if (kinds.empty() || std::find(kinds.begin(), kinds.end(), label.kind) != kinds.end())
      out.insert(out.end(), count, label);
  return out;
}

const MonitoredEpisode* episode_of_fault(const MonitoredRun& run) {
  for (const MonitoredEpisode& episode : run.log.episodes)
    if (episode.alarm_s() >= run.onset_s) return &episode;
  return nullptr;
}

Validated validate(std::span<const MonitoredRun> faulty, std::span<const MonitoredRun> healthy,
                   const Model& model, const CaseBase& cases) {
  Validated out;
  Validation& validation = out.validation;
  std::map<FaultKind, ValidationRow> rows;
  std::map<FaultKind, std::vector<double>> delays;
  for (const MonitoredRun& run : faulty) {
    ValidationRow& row = rows[run.label.kind];
    row.kind = run.label.kind;
    ++row.runs;
    validation.early_alarms += alarmed_early(run);
    const MonitoredEpisode* episode = episode_of_fault(run);
    if (!episode) continue;
    const FaultFinding finding = decide_episode(*episode, model, cases);
    count(run, episode->alarm_s(), finding, row, delays[run.label.kind]);
    if (finding.label.kind != FaultKind::unknown)
      out.judged.push_back(
          {confidence_source(finding.decided_by), finding.confidence, finding.label == run.label});
  }
  for (auto& [kind, row] : rows) {
    row.median_delay_s = lower_quantile(delays[kind], 0.5);
    row.p90_delay_s = lower_quantile(delays[kind], 0.9);
    validation.rows.push_back(row);
  }
  for (const MonitoredRun& run : healthy) {
    validation.healthy_hours += run.length_s / 3600;
    validation.false_alarms += static_cast<int>(run.log.episodes.size());
  }
  validation.raw_confidence_error = calibration_error(out.judged);
  validation.confidence_error = held_out_calibration_error(out.judged);
  return out;
}

std::vector<Detectability> detectability_of(std::span<const MonitoredRun> runs,
                                            const std::vector<std::vector<LeastFound>>& by_log) {
  std::vector<Detectability> all;
  for (const MonitoredRun& run : runs) {
    const bool known =
        std::any_of(all.begin(), all.end(), [&](const Detectability& r) { return r.label == run.label; });
    if (!known && run.label.kind != FaultKind::none) all.push_back(detectability_of(run.label, runs, by_log));
  }
  return all;
}

}  // namespace faultline
