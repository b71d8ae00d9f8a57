// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "lib/batch/batch_row.hpp"
#include "lib/core/csv_cell.hpp"
#include "lib/core/json/json_fields.hpp"
#include "lib/core/json_values.hpp"
#include "lib/core/outgoing/json_text.hpp"
#include "lib/diagnose/fault_event_fields.hpp"
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

Json report_json(const std::string& result) {
  return result.empty() ? Json(nullptr) : Json("logs/" + result + ".json");
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

void fields(auto& v, MaybeConst<BatchRow> auto& row) {
  v("log", row.log);
  v.or_null("sha256", row.sha256);
  v("model", row.model);
  v.or_null("model_sha256", row.model_sha256);
  v.as("report", row.result, report_json, result_from);
  v("verdict", row.verdict);
  v.or_null("reason", row.reason);
  v("faults", row.faults);
  v.or_null("format", row.format);
  v("rows", row.rows);
  v("rows_used", row.rows_used);
  v("start_s", row.start_s);
  v("end_s", row.end_s);
  v("sample_period_s", row.sample_period_s);
  v("joints", row.joints);
  v("warnings", row.warnings);
  v("severe", row.severe);
  v("residual_rms", row.residual_rms);
  v("residual_peak", row.residual_peak);
  v.as("condition", row.condition, parameters_json, parameters_from);
  v.as("parameters", row.parameters, parameters_json, parameters_from);
  v.or_null("doubt", row.doubt);
}

std::string to_json_line(const BatchRow& row) {
  const Json json = fields_to_json<Json>(row);
  return inert_json(json.dump(-1, ' ', false, Json::error_handler_t::replace)) + "\n";
}

BatchRow row_from_json(const std::string& line) { return fields_from_json<BatchRow>(Json::parse(line), ""); }

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
