// SPDX-License-Identifier: MIT
#include "apps/work/diagnosis_recording.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "formats/mcap/mcap_recording.hpp"
#include "formats/messages/message_source.hpp"
#include "formats/provenance.hpp"
#include "lib/core/atomic_file.hpp"
#include "lib/core/error.hpp"
#include "lib/diagnose/curves/required_torque.hpp"
#include "lib/diagnose/curves/window_curves.hpp"
#include "lib/diagnose/monitor/model_rate.hpp"
#include "lib/fault/fault_kind.hpp"
#include "lib/report/text.hpp"

namespace faultline {
namespace {

using ReportJson = nlohmann::json;

constexpr const char* kSchema = "faultline/diagnosis/1";
constexpr std::size_t kMostBytes = 256 << 20;

/// Returns "collision of joint 1 (fault 1, confidence 0.97)".
std::string fault_text(const ReportJson& fault) {
  std::string text = fault.at("kind").get<std::string>();
  if (const auto joint = fault.find("joint"); joint != fault.end() && joint->is_number())
    text += fmt::format(" of joint {}", joint->get<int>());
  text += fmt::format(" (fault {}", fault.at("id").get<int>());
  if (const auto confidence = fault.find("confidence"); confidence != fault.end() && confidence->is_number())
    text += fmt::format(", confidence {:.2f}", confidence->get<double>());
  return text + ")";
}

void add_events(const ReportJson& fault, std::vector<LogEvent>& events) {
  const std::string text = fault_text(fault);
  const auto add = [&](const char* member, const char* what, bool grave) {
    if (const auto time = fault.find(member); time != fault.end() && time->is_number())
      events.push_back({time->get<double>(), grave, what + text});
  };
  add("onset_s", "begins: ", true);
  add("alarm_s", "alarm: ", false);
  add("end_s", "ends: ", false);
}

/// Adds the verdict of a log without faults at its start: an empty list of events would be taken for health
/// even without a verdict.
void add_verdict(const ReportJson& diagnosis, std::vector<LogEvent>& events) {
  const auto verdict = diagnosis.find("verdict"), log = diagnosis.find("log");
  if (verdict == diagnosis.end() || log == diagnosis.end()) return;
  const ReportJson start = log->value("start_s", ReportJson()),
                   reason = diagnosis.value("verdict_reason", ReportJson());
  if (!start.is_number()) return;
  const std::string found = *verdict == "healthy" ? "no fault found" : "no verdict";
  events.push_back(
      {start.get<double>(), false, reason.is_string() ? found + ": " + reason.get<std::string>() : found});
}

/// Adds the moment that the diagnosis was asked about, and the first sign of it.
void add_stop(const ReportJson& diagnosis, std::vector<LogEvent>& events) {
  const auto stop = diagnosis.find("stop");
  if (stop == diagnosis.end()) return;
  const auto text = [](const ReportJson& sign) {
    std::string words = "first sign";
    for (const char* member : {"kind", "signal"})
      if (sign.at(member).is_string()) words += ": " + sign.at(member).get<std::string>();
    if (sign.at("joint").is_number()) words += fmt::format(" of joint {}", sign.at("joint").get<int>());
    return words;
  };
  events.push_back({stop->at("time_s").get<double>(), true, "stop"});
  if (const ReportJson& sign = stop->at("first_sign"); sign.is_object())
    events.push_back({sign.at("time_s").get<double>(), true, text(sign)});
}

/// Returns the events of a report; `where` names it.
std::vector<LogEvent> events_of_diagnosis(const std::string& report, const std::string& where) {
  const ReportJson diagnosis = ReportJson::parse(report, nullptr, false);
  std::vector<LogEvent> events;
  try {
    if (!diagnosis.is_object() || diagnosis.at("schema") != kSchema) throw Error(ErrorCode::input, where, "");
    for (const ReportJson& fault : diagnosis.at("faults")) add_events(fault, events);
    if (diagnosis.at("faults").empty()) add_verdict(diagnosis, events);
    add_stop(diagnosis, events);
  } catch (const std::exception&) {
    throw Error(
        ErrorCode::input, where,
        std::string("is not a diagnosis (schema ") + kSchema + "); write one with faultline diagnose --json");
  }
  std::stable_sort(events.begin(), events.end(),
                   [](const LogEvent& a, const LogEvent& b) { return a.time_s < b.time_s; });
  return events;
}

ComputedSignals signals_of(const char* topic, int joints, bool with_velocity) {
  const JointSignals empty(joints);
  return {topic, empty, with_velocity ? empty : JointSignals{}, empty};
}

/// Predictions and residuals, the latter in units of their healthy rms, those of torque in N m or N.
ComputedRows computed_rows(const Model& model, const Log& segment, const Residuals& residuals,
                           const RequiredTorque& torque) {
  ComputedRows computed;
  const int joints = residuals.joints();
  if (joints == 0) return computed;
  const bool measured = !segment.dq.empty();
  ComputedSignals predicted = signals_of(kPredictedTopic, joints, measured),
                  residual = signals_of(kResidualsTopic, joints, true);
  for (int i = 0; i < residuals.count(); ++i) {
    computed.row.push_back(static_cast<int>(residuals.row[i] - segment.first_row));
    for (int j = 0; j < joints; ++j) {
      const ExpectedJoint expected =
          expected_joint(model.residual.healthy, segment, computed.row.back(), residuals, i, j);
      predicted.position[j].push_back(expected.q);
      if (measured) predicted.velocity[j].push_back(expected.dq);
      predicted.effort[j].push_back(torque(j, computed.row.back()));
      residual.position[j].push_back(residuals.position(j, i));
      residual.velocity[j].push_back(residuals.velocity(j, i));
      residual.effort[j].push_back(residuals.torque(j, i));
    }
  }
  computed.signals = {std::move(predicted), std::move(residual)};
  return computed;
}

/// Returns the evidence of the most likely labels of a fault; names such as "torque_loss_2" are paths of a
/// plot.
NamedCurves evidence_of(const FaultFinding& fault) {
  NamedCurves curves;
  curves.topic = std::string(kEvidenceTopic) + "/fault_" + std::to_string(fault.id);
  curves.time = fault.trace.time;
  for (const EvidenceCurve& curve : fault.trace.curves) {
    curves.names.push_back(label_text(curve.label, "_"));
    curves.values.push_back(curve.ratio);
  }
  return curves;
}

}  // namespace

std::vector<LogEvent> events_of_file(const std::string& path) {
  return events_of_diagnosis(read_file(path, kMostBytes), path);
}

void write_recording(const std::string& path, LogSource& log, const Model& model,
                     const Diagnosis& diagnosis) {
  const auto recording = create_mcap_recording(path);
  std::unique_ptr<LogSource> kept;
  LogSource& judged = judged_rows(log, model, diagnosis.log.issues, kept);
  ResidualState state;
  for_each_with_required_torque(
      judged, model, diagnosis, [&](const Log& segment, const RequiredTorque& torque) {
        const Residuals residuals = compute_residuals(model.residual, segment, state);
        recording->write(segment, computed_rows(model, segment, residuals, torque));
      });
  for (const FaultFinding& fault : diagnosis.faults)
    if (!fault.trace.time.empty()) recording->write(evidence_of(fault));
  const std::string report = render_json(diagnosis);
  recording->note_events(events_of_diagnosis(report, path));
  recording->note("faultline/diagnosis", report);
  const std::string provenance = provenance_of(log);
  if (!provenance.empty()) recording->note_provenance(provenance);
  recording->commit();
}

}  // namespace faultline
