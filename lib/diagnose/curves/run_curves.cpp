// SPDX-License-Identifier: MIT
#include "lib/diagnose/curves/run_curves.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "lib/diagnose/curves/required_torque.hpp"
#include "lib/diagnose/curves/window_curves.hpp"
#include "lib/diagnose/monitor/model_rate.hpp"

namespace faultline {
namespace {

/// Number of bins of at least two samples each, so that none is empty; at most `most`.
int bins_for(double span_s, double period_s, int most) {
  if (!(period_s > 0.0)) return most;
  return static_cast<int>(std::clamp(span_s / (2.0 * period_s), 1.0, static_cast<double>(most)));
}

/// Sample period of the rows that were judged, s; 0 if not known.
double judged_period(const Model& model, const LogFacts& log) {
  if (log.issues.find(kResampled)) return model.sample_period_s;
  return std::isfinite(log.sample_period_s) ? log.sample_period_s : 0.0;
}

CurveWindow window_of(const FaultFinding& fault, const LogFacts& log, double period,
                      const RunCurvesOptions& options, int most_bins) {
  const double alarm = std::isfinite(fault.alarm_s) ? fault.alarm_s : fault.onset_s;
  CurveWindow window;
  window.fault_id = fault.id;
  window.start_s =
      std::max(log.start_s, fault.onset_s - std::max(options.lead_s, options.lead_samples * period));
  window.end_s = std::min(
      log.end_s, std::max(alarm, fault.onset_s) + std::max(options.tail_s, options.tail_samples * period));
  window.bins = bins_for(window.end_s - window.start_s, period, most_bins);
  return window;
}

/// Labels whose network outputs are shown: up to two of the fault's own and the networks', and fault-free.
std::vector<FaultLabel> asked_about(const FaultFinding& fault) {
  std::vector<FaultLabel> labels;
  for (const FaultLabel& label : {fault.label, fault.mlp.label, fault.rbfn.label})
    if (label.kind != FaultKind::none && std::find(labels.begin(), labels.end(), label) == labels.end())
      labels.push_back(label);
  if (labels.size() > 2) labels.resize(2);
  labels.push_back({FaultKind::none});
  return labels;
}

std::vector<WindowCurves> detail_windows(const Model& model, const Diagnosis& diagnosis,
                                         const RunCurvesOptions& options) {
  const int shown = std::min(static_cast<int>(diagnosis.faults.size()), options.most_details);
  const int most_bins =
      shown == 0 ? 0
                 : std::min(options.detail_bins, 4 * options.all_details / (model.robot.joints() * shown));
  std::vector<WindowCurves> details;
  for (int i = 0; i < shown; ++i) {
    const FaultFinding& fault = diagnosis.faults[i];
    const CurveWindow window =
        window_of(fault, diagnosis.log, judged_period(model, diagnosis.log), options, most_bins);
    if (window.end_s > window.start_s) details.emplace_back(window, model, asked_about(fault));
  }
  return details;
}

RunCurves without_curves(const Model& model, const LogFacts& log) {
  RunCurves curves;
  const HealthyResiduals& healthy = model.residual.healthy;
  for (int j = 0; j < model.robot.joints(); ++j) {
    if (model.has_mechanics())
      curves.healthy_residual.push_back(healthy.velocity_max[j] / healthy.velocity_rms[j]);
    curves.turns.push_back(model.robot.chain.geometry[j].kind == AxisKind::revolute);
  }
  curves.by_reference = log.is_tracked;
  curves.torque = model.robot.log.torque;
  curves.alarm_ratio = least_limit(model.explain.limits);
  return curves;
}

}  // namespace

RunCurves run_curves(LogSource& log, const Model& model, const Diagnosis& diagnosis,
                     const RunCurvesOptions& options) {
  RunCurves curves = without_curves(model, diagnosis.log);
  const LogFacts& facts = diagnosis.log;
  if (!(facts.end_s > facts.start_s)) return curves;
  CurveWindow run;
  run.start_s = facts.start_s;
  run.end_s = facts.end_s;
  run.bins = bins_for(run.end_s - run.start_s, judged_period(model, facts), options.whole_bins);
  WindowCurves whole(run, model, {});
  std::vector<WindowCurves> details = detail_windows(model, diagnosis, options);
  std::unique_ptr<LogSource> kept;
  LogSource& judged = judged_rows(log, model, facts.issues, kept);
  ResidualState state;
  for_each_with_required_torque(
      judged, model, diagnosis, [&](const Log& segment, const RequiredTorque& torque) {
        const Residuals residuals = compute_residuals(model.residual, segment, state);
        whole.take(segment, residuals, torque);
        for (WindowCurves& detail : details) detail.take(segment, residuals, torque);
      });
  curves.whole = whole.curves();
  for (const WindowCurves& detail : details) curves.details.push_back(detail.curves());
  return curves;
}

}  // namespace faultline
