// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "lib/batch/batch_row.hpp"

namespace faultline {
namespace {

using Json = nlohmann::ordered_json;

Json number(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }
Json text(const std::string& t) { return t.empty() ? Json(nullptr) : Json(t); }
Json numbers(const std::vector<double>& values) {
  Json json = Json::array();
  for (const double value : values) json.push_back(number(value));
  return json;
}

double number_in(const Json& json) {
  return json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();
}
std::string text_in(const Json& json) { return json.is_null() ? "" : json.get<std::string>(); }
std::vector<double> numbers_in(const Json& json) {
  std::vector<double> values;
  for (const Json& value : json) values.push_back(number_in(value));
  return values;
}

Json parameters_json(const std::vector<ParameterValue>& parameters) {
  Json json = Json::object();
  for (const ParameterValue& p : parameters)
    json[p.name] = {{"value", number(p.value)}, {"std", number(p.std)}};
  return json;
}

Json report_json(const BatchRow& row) {
  return row.result.empty() ? Json(nullptr) : Json("logs/" + row.result + ".json");
}

std::string result_from(const Json& report) {
  const std::string path = text_in(report);
  return path.size() < 10 ? "" : path.substr(5, path.size() - 10);
}

std::string cell(const std::string& value) {
  if (value.find_first_of(",\"\r\n") == std::string::npos) return value;
  std::string quoted = "\"";
  for (const char c : value) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string cell(double value) { return std::isfinite(value) ? fmt::format("{}", value) : ""; }

std::string fault_words(const FaultEvent& fault) {
  std::string words = to_string(fault.label.kind);
  if (fault.label.joint > 0) words += fmt::format(" {}", fault.label.joint);
  return std::isfinite(fault.onset_s) ? words + fmt::format(" @{}", fault.onset_s) : words;
}

}  // namespace

std::string to_json_line(const BatchRow& row) {
  Json faults = Json::array();
  for (const FaultEvent& fault : row.faults) faults.push_back(to_json(fault));
  const Json json = {{"log", row.log},
                     {"sha256", text(row.sha256)},
                     {"report", report_json(row)},
                     {"verdict", row.verdict},
                     {"reason", text(row.reason)},
                     {"faults", faults},
                     {"format", text(row.format)},
                     {"rows", row.rows},
                     {"rows_used", row.rows_used},
                     {"start_s", number(row.start_s)},
                     {"end_s", number(row.end_s)},
                     {"sample_period_s", number(row.sample_period_s)},
                     {"joints", row.joints},
                     {"warnings", row.warnings},
                     {"severe", row.severe},
                     {"residual_rms", numbers(row.residual_rms)},
                     {"residual_peak", numbers(row.residual_peak)},
                     {"parameters", parameters_json(row.parameters)}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

BatchRow row_from_json(const std::string& line) {
  const Json json = Json::parse(line);
  BatchRow row;
  row.log = json.at("log").get<std::string>();
  row.sha256 = text_in(json.at("sha256"));
  row.result = result_from(json.at("report"));
  row.verdict = json.at("verdict").get<std::string>();
  row.reason = text_in(json.at("reason"));
  for (const Json& fault : json.at("faults")) row.faults.push_back(fault_event_from_json(fault));
  row.format = text_in(json.at("format"));
  row.rows = json.at("rows").get<std::int64_t>();
  row.rows_used = json.at("rows_used").get<std::int64_t>();
  row.start_s = number_in(json.at("start_s"));
  row.end_s = number_in(json.at("end_s"));
  row.sample_period_s = number_in(json.at("sample_period_s"));
  row.joints = json.at("joints").get<int>();
  row.warnings = json.at("warnings").get<int>();
  row.severe = json.at("severe").get<int>();
  row.residual_rms = numbers_in(json.at("residual_rms"));
  row.residual_peak = numbers_in(json.at("residual_peak"));
  for (const auto& [name, p] : json.at("parameters").items())
    row.parameters.push_back({name, number_in(p.at("value")), number_in(p.at("std")), ""});
  return row;
}

std::string batch_csv_header() {
  return "file,verdict,faults,fault,joint,onset_s,end_s,alarm_s,confidence,all_faults,residual,rows,rows_used,"
         "start_s,log_end_s,sample_period_s,warnings,severe,reason,report,log_sha256\n";
}

std::string to_csv_line(const BatchRow& row) {
  std::string all, first = ",,,,,";
  for (const FaultEvent& fault : row.faults) all += (all.empty() ? "" : ";") + fault_words(fault);
  if (!row.faults.empty()) {
    const FaultEvent& f = row.faults.front();
    first = fmt::format("{},{},{},{},{},{}", to_string(f.label.kind),
                        f.label.joint > 0 ? std::to_string(f.label.joint) : "", cell(f.onset_s),
                        cell(f.end_s), cell(f.alarm_s), cell(f.confidence));
  }
  return fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", cell(row.log), row.verdict,
                     row.faults.size(), first, cell(all), cell(residual_level(row)), row.rows, row.rows_used,
                     cell(row.start_s), cell(row.end_s), cell(row.sample_period_s), row.warnings, row.severe,
                     cell(row.reason), row.result.empty() ? "" : "logs/" + row.result + ".json", row.sha256);
}

}  // namespace faultline
