// SPDX-License-Identifier: MIT
#include "apps/work/diagnosis_events.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "lib/core/atomic_file.hpp"
#include "lib/core/error.hpp"

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

}  // namespace

std::vector<LogEvent> events_of_file(const std::string& path) {
  return events_of_diagnosis(read_file(path, kMostBytes), path);
}

std::vector<LogEvent> events_of_diagnosis(const std::string& report, const std::string& where) {
  const ReportJson diagnosis = ReportJson::parse(report, nullptr, false);
  std::vector<LogEvent> events;
  try {
    if (!diagnosis.is_object() || diagnosis.at("schema") != kSchema) throw Error(ErrorCode::input, where, "");
    for (const ReportJson& fault : diagnosis.at("faults")) add_events(fault, events);
    if (diagnosis.at("faults").empty()) add_verdict(diagnosis, events);
  } catch (const std::exception&) {
    throw Error(
        ErrorCode::input, where,
        std::string("is not a diagnosis (schema ") + kSchema + "); write one with faultline diagnose --json");
  }
  std::stable_sort(events.begin(), events.end(),
                   [](const LogEvent& a, const LogEvent& b) { return a.time_s < b.time_s; });
  return events;
}

}  // namespace faultline
