// SPDX-License-Identifier: MIT
#include "lib/diagnose/stop/explain_stop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "lib/core/error.hpp"
#include "lib/core/number_text.hpp"
#include "lib/diagnose/diagnose.hpp"
#include "lib/diagnose/monitor/model_rate.hpp"
#include "lib/diagnose/stop/stop_channels.hpp"
#include "lib/diagnose/stop/stop_reach.hpp"
#include "lib/diagnose/stop/stop_sentences.hpp"
#include "lib/diagnose/stop/stop_signs.hpp"
#include "lib/log/log.hpp"

namespace faultline {
namespace {

constexpr double kLastMoment_s = 1.0;     // length of the last moment before a stop,
constexpr double kLastMomentSamples = 5;  // at least so many samples

void check_moment(const LogFacts& log, double time_s) {
  const double slack_s = log.sample_period_s > 0.0 ? log.sample_period_s : 0.0;
  if (time_s >= log.start_s - slack_s && time_s <= log.end_s + slack_s) return;
  throw Error(ErrorCode::usage, log.path,
              fmt::format("the moment {} is outside of the log, which has rows from {} to {}; give a moment "
                          "within it, in the time of the log",
                          time_text(time_s, log.sample_period_s), time_text(log.start_s, log.sample_period_s),
                          time_text(log.end_s, log.sample_period_s)));
}

/// Begin of the run of the clock in which the moment lies; no value of it belongs to the run before.
double run_start(const LogFacts& log, double time_s) {
  double start_s = log.start_s;
  for (const LogRun& run : log.runs)
    if (run.is_read && run.start_s <= time_s) start_s = std::max(start_s, run.start_s);
  return start_s;
}

/// Reads the rows from `from_s` to `to_s`, both inclusive.
Log rows_between(LogSource& log, double from_s, double to_s) {
  Log out;
  log.rewind();
  for (Log segment; log.next(segment);) {
    const auto begin = std::lower_bound(segment.time.begin(), segment.time.end(), from_s);
    const auto end = std::upper_bound(segment.time.begin(), segment.time.end(), to_s);
    if (begin < end)
      append(out, slice(segment, static_cast<int>(begin - segment.time.begin()),
                        static_cast<int>(end - segment.time.begin())));
    if (end != segment.time.end()) break;
  }
  log.rewind();
  return out;
}

/// Returns the rows on the grid of the regression; empty if it cannot judge them.
std::optional<UniformLog> judged_rows_of(const Log& rows, const Model& model, bool is_judged) {
  if (!is_judged || !model.has_mechanics() || rows.rows() < 2 || rows.tau.empty()) return std::nullopt;
  MemorySource source(rows);
  try {
    UniformLog uniform = uniform_log(source, model.sample_period_s);
    if (can_explain(uniform, model.explain.robot)) return uniform;
  } catch (const Error&) {  // fewer than two complete rows
  }
  return std::nullopt;
}

constexpr double kSameFault_s = 1.0;  // distance of two onsets of one fault, as of parts that are merged

/// Returns the diagnosis of the rows up to the stop; empty if they cannot be diagnosed.
Diagnosis diagnosis_of(const Log& rows, const Model& model, const CaseBase& cases, DiagnoseOptions options) {
  options.stop.reset();
  if (rows.rows() < 2) return {};
  MemorySource source(rows);
  try {
    return diagnose(source, model, cases, options);
  } catch (const Error&) {  // too few rows
    return {};
  }
}

StopFinding finding_before(const FaultFinding& fault, double stop_s) {
  StopFinding out{fault.label};
  out.onset_s = fault.onset_s;
  out.confidence = fault.confidence;
  out.before_s = stop_s - fault.onset_s;
  out.ended_before_s = std::isfinite(fault.end_s) ? std::max(stop_s - fault.end_s, 0.0) : 0.0;
  return out;
}

/// Returns the faults of the rows up to the stop, and those of the whole log that began before it and are not
/// among them. Those of the rows up to the stop come first; among them those that are present at the stop,
/// the latest onset first, then those that ended, the latest first.
std::vector<StopFinding> findings_before(const std::vector<FaultFinding>& by_rows_before,
                                         const Diagnosis& diagnosis, double stop_s, double present_s) {
  std::vector<StopFinding> out;
  for (const FaultFinding& fault : by_rows_before) {
    out.push_back(finding_before(fault, stop_s));
    // A fault that lasts to the end of the rows was present at the stop.
    if (out.back().ended_before_s <= present_s) out.back().ended_before_s = 0.0;
  }
  for (const FaultFinding& fault : diagnosis.faults) {
    if (!(fault.onset_s <= stop_s)) continue;
    const auto same = std::find_if(out.begin(), out.end(), [&](const StopFinding& own) {
      return own.label == fault.label && std::abs(own.onset_s - fault.onset_s) <= kSameFault_s;
    });
    if (same != out.end()) {
      same->fault_id = fault.id;
      continue;
    }
    StopFinding later = finding_before(fault, stop_s);
    later.fault_id = fault.id;
    later.by_rows_before = fault.alarm_s <= stop_s;
    out.push_back(later);
  }
  std::stable_sort(out.begin(), out.end(), [](const StopFinding& a, const StopFinding& b) {
    return std::tuple(!a.by_rows_before, a.ended_before_s, a.before_s) <
           std::tuple(!b.by_rows_before, b.ended_before_s, b.before_s);
  });
  return out;
}

/// The earliest onset of the faults that the rows up to the stop show and that last up to its last moment;
/// without such a fault, the earliest deviation of a signal that does.
std::optional<FirstSign> first_sign(const StopAnswer& stop, bool by_motion) {
  const double stop_s = stop.question.time_s;
  std::optional<FirstSign> out;
  const auto offer = [&](const FirstSign& sign) {
    if (!out || sign.time_s < out->time_s) out = sign;
  };
  for (const StopFinding& finding : stop.findings)
    if (finding.by_rows_before && finding.ended_before_s <= stop.moment_s)
      offer({finding.onset_s, finding.before_s, finding.label.joint, finding.label.kind});
  if (out) return out;
  for (const StopChannel& channel : stop.channels) {
    const bool is_motion =
        channel.signal == StopSignal::motion_velocity || channel.signal == StopSignal::motion_position;
    if (channel.state == SignalState::changed && channel.signal < StopSignal::torque &&
        (by_motion || !is_motion))
      offer({channel.since_s, stop_s - channel.since_s, channel.joint, FaultKind::none, channel.signal});
  }
  return out;
}

void set_leading(StopAnswer& stop, int joints) {
  const std::vector<double> times = times_healthy(stop.channels, joints);
  std::vector<LeadingJoint> order;
  for (int j = 0; j < joints; ++j)
    if (std::isfinite(times[j])) order.push_back({Joint::at(j), times[j]});
  std::stable_sort(order.begin(), order.end(),
                   [](const auto& a, const auto& b) { return a.times_healthy > b.times_healthy; });
  if (!order.empty()) stop.leading = order[0];
  if (order.size() > 1) stop.runner_up = order[1];
}

}  // namespace

StopAnswer explain_stop(LogSource& judged, const Model& model, const CaseBase& cases,
                        const DiagnoseOptions& options, const Diagnosis& diagnosis) {
  const StopQuestion question = options.stop.value_or(StopQuestion{});
  const LogFacts& log = diagnosis.log;
  check_moment(log, question.time_s);
  const double stop_s = std::clamp(question.time_s, log.start_s, log.end_s);
  StopAnswer out;
  out.question = {stop_s, question.column};
  StopRows rows;
  rows.stop_s = stop_s;
  rows.period_s = model.sample_period_s > 0.0 ? model.sample_period_s : log.sample_period_s;
  rows.moment_s = out.moment_s = std::max(kLastMoment_s, kLastMomentSamples * rows.period_s);
  out.looked_from_s = std::max(run_start(log, stop_s), stop_s - model.explain.window_s);
  rows.log = rows_between(judged, out.looked_from_s, stop_s);
  const bool has_rate = log.is_tracked || log_rate(judged, model).is_models();
  const Diagnosis before = has_rate ? diagnosis_of(rows.log, model, cases, options) : Diagnosis{};
  const bool is_judged = has_rate && !before.log.issues.find(kMisreadLog);
  const std::optional<UniformLog> uniform = judged_rows_of(rows.log, model, is_judged);
  if (uniform) rows.course = balance_course(*uniform, model.explain);
  if (is_judged && rows.log.rows() > 0) out.channels = stop_channels(rows, model);
  out.findings = findings_before(before.faults, diagnosis, stop_s, kLastMomentSamples * rows.period_s);
  out.first_sign = first_sign(out, !rows.course);
  set_leading(out, rows.log.joints());
  out.seen = seen_changes(rows, uniform, model, diagnosis);
  out.short_log = short_log(diagnosis, rows);
  out.summary = stop_summary(out, diagnosis);
  out.not_looked_at = stop_not_looked(out, diagnosis);
  if (!is_judged)
    out.not_looked_at.insert(out.not_looked_at.begin(),
                             "The rows up to the stop do not match the model: no signal was compared.");
  return out;
}

}  // namespace faultline
