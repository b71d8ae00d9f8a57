// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "lib/batch/batch_row.hpp"
#include "lib/core/csv_cell.hpp"
#include "lib/core/json_values.hpp"
#include "lib/core/outgoing/json_text.hpp"
#include "lib/fault/label_text.hpp"

namespace faultline {
namespace {

using Json = nlohmann::ordered_json;

Json parameters_json(const std::vector<ParameterValue>& parameters) {
  Json json = Json::object();
  for (const ParameterValue& p : parameters)
    json[p.name] = {{"value", number_or_null(p.value)}, {"std", number_or_null(p.std)}};
  return json;
}

std::vector<ParameterValue> parameters_from(const Json& json) {
  std::vector<ParameterValue> values;
  for (const auto& [name, p] : json.items())
    values.push_back({name, number_or_nan(p.at("value")), number_or_nan(p.at("std")), ""});
  return values;
}

Json report_json(const BatchRow& row) {
  return row.result.empty() ? Json(nullptr) : Json("logs/" + row.result + ".json");
}

/// As it stands there when it is no file of logs/, which no batch writes.
std::string result_from(const Json& report) {
  const std::string path = text_or_empty(report), folder = "logs/", extension = ".json";
  if (!path.starts_with(folder) || !path.ends_with(extension)) return path;
  return path.substr(folder.size(), path.size() - folder.size() - extension.size());
}

std::string fault_words(const FaultEvent& fault) {
  const std::string words =
      label_text(fault.label) + (fault.run > 0 ? fmt::format(" run {}", fault.run) : "");
  return std::isfinite(fault.onset_s) ? words + fmt::format(" @{}", fault.onset_s) : words;
}

}  // namespace

std::string to_json_line(const BatchRow& row) {
  const Json json = {
      {"log", row.log},
      {"sha256", text_or_null(row.sha256)},
      {"model", row.model},
      {"model_sha256", text_or_null(row.model_sha256)},
      {"report", report_json(row)},
      {"verdict", row.verdict},
      {"reason", text_or_null(row.reason)},
      {"faults", list_of<Json>(row.faults, [](const FaultEvent& fault) -> Json { return to_json(fault); })},
      {"format", text_or_null(row.format)},
      {"rows", row.rows},
      {"rows_used", row.rows_used},
      {"start_s", number_or_null(row.start_s)},
      {"end_s", number_or_null(row.end_s)},
      {"sample_period_s", number_or_null(row.sample_period_s)},
      {"joints", row.joints},
      {"warnings", row.warnings},
      {"severe", row.severe},
      {"residual_rms", numbers_or_null(row.residual_rms)},
      {"residual_peak", numbers_or_null(row.residual_peak)},
      {"condition", parameters_json(row.condition)},
      {"parameters", parameters_json(row.parameters)},
      {"doubt", text_or_null(row.doubt)}};
  return inert_json(json.dump(-1, ' ', false, Json::error_handler_t::replace)) + "\n";
}

BatchRow row_from_json(const std::string& line) {
  const Json json = Json::parse(line);
  BatchRow row;
  row.log = json.at("log").get<std::string>();
  row.sha256 = text_or_empty(json.at("sha256"));
  row.model = json.at("model").get<std::string>();
  row.model_sha256 = text_or_empty(json.at("model_sha256"));
  row.result = result_from(json.at("report"));
  row.verdict = json.at("verdict").get<std::string>();
  row.reason = text_or_empty(json.at("reason"));
  for (const Json& fault : json.at("faults")) row.faults.push_back(fault_event_from_json(fault));
  row.format = text_or_empty(json.at("format"));
  row.rows = json.at("rows").get<std::int64_t>();
  row.rows_used = json.at("rows_used").get<std::int64_t>();
  row.start_s = number_or_nan(json.at("start_s"));
  row.end_s = number_or_nan(json.at("end_s"));
  row.sample_period_s = number_or_nan(json.at("sample_period_s"));
  row.joints = json.at("joints").get<int>();
  row.warnings = json.at("warnings").get<int>();
  row.severe = json.at("severe").get<int>();
  row.residual_rms = numbers_or_nan(json.at("residual_rms"));
  row.residual_peak = numbers_or_nan(json.at("residual_peak"));
  row.condition = parameters_from(json.at("condition"));
  row.parameters = parameters_from(json.at("parameters"));
  row.doubt = text_or_empty(json.at("doubt"));
  return row;
}

std::string batch_csv_header() {
  return "file,verdict,faults,fault,joint,onset_s,end_s,alarm_s,confidence,all_faults,residual,rows,"
         "rows_used,start_s,log_end_s,sample_period_s,warnings,severe,reason,report,log_sha256,model,model_sha256,doubt\n";
}

std::string to_csv_line(const BatchRow& row) {
  std::string all, first = ",,,,,";
  for (const FaultEvent& fault : row.faults) all += (all.empty() ? "" : ";") + fault_words(fault);
  if (!row.faults.empty()) {
    const FaultEvent& f = row.faults.front();
    first = fmt::format("{},{},{},{},{},{}", to_string(f.label.kind), csv_joint(f.label.joint),
                        csv_cell(f.onset_s), csv_cell(f.end_s), csv_cell(f.alarm_s), csv_cell(f.confidence));
  }
  return fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", csv_cell(row.log),
                     row.verdict, row.faults.size(), first, csv_cell(all), csv_cell(residual_level(row)),
                     row.rows, row.rows_used, csv_cell(row.start_s), csv_cell(row.end_s),
                     csv_cell(row.sample_period_s), row.warnings, row.severe, csv_cell(row.reason),
                     row.result.empty() ? "" : "logs/" + row.result + ".json", row.sha256,
                     csv_cell(row.model), row.model_sha256, csv_cell(row.doubt));
}

}  // namespace faultline
