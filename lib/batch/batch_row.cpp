// SPDX-License-Identifier: MIT
#include "lib/batch/batch_row.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "lib/core/csv_cell.hpp"
#include "lib/core/json/json_fields.hpp"
#include "lib/core/json_values.hpp"
#include "lib/core/outgoing/json_text.hpp"
#include "lib/core/statistics.hpp"
#include "lib/core/text.hpp"
#include "lib/diagnose/fault_event.hpp"
#include "lib/fault/fault_kind.hpp"

namespace faultline {
namespace {

int issues_of(const Diagnosis& diagnosis, Severity severity) {
  const auto& all = diagnosis.log.issues.all();
  return static_cast<int>(
      std::count_if(all.begin(), all.end(), [&](const Issue& issue) { return issue.severity == severity; }));
}

/// "row 17, column tau2" of "/data/run.csv, row 17, column tau2".
std::string place_inside(const std::string& where, const std::string& path) {
  if (!where.starts_with(path)) return where;
  const std::size_t begin = where.find_first_not_of(", :", path.size());
  return begin == std::string::npos ? "" : where.substr(begin);
}

using Json = nlohmann::ordered_json;

Json parameters_json(const std::vector<ParameterValue>& parameters) {
  Json json = Json::object();
  for (const ParameterValue& p : parameters)
    json[p.name] = {{"value", number_or_null(p.value)}, {"std", number_or_null(p.std)}};
  return json;
}

/// With its unit, in which the values of a series are read.
Json condition_json(const std::vector<ParameterValue>& condition) {
  Json json = parameters_json(condition);
  for (const ParameterValue& item : condition)
    if (!item.unit.empty()) json[item.name]["unit"] = item.unit;
  return json;
}

std::vector<ParameterValue> parameters_from(const Json& json) {
  std::vector<ParameterValue> values;
  for (const auto& [name, p] : json.items())
    values.push_back({name, number_or_nan(p.at("value")), number_or_nan(p.at("std")), p.value("unit", "")});
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

BatchRow row_of(const Diagnosis& d) {
  BatchRow row;
  row.log = valid_utf8(d.log.path);
  row.sha256 = d.log.sha256;
  row.model = valid_utf8(d.model.name);
  row.model_sha256 = d.model.sha256;
  row.verdict = to_string(d.verdict);
  row.reason = valid_utf8(d.verdict_reason);
  if (!d.model.grave_doubts.empty()) row.doubt = valid_utf8(d.model.grave_doubts.front());
  row.format = d.log.format;
  row.rows = d.log.rows_read;
  row.rows_used = d.log.rows_used;
  row.start_s = d.log.start_s;
  row.end_s = d.log.end_s;
  row.sample_period_s = d.log.sample_period_s;
  row.joints = d.log.joints;
  row.warnings = issues_of(d, Severity::warning);
  row.severe = issues_of(d, Severity::severe);
  if (d.score.is_known()) row.score = d.score.ratio();
  for (const JointResidual& residual : d.residuals) {
    row.residual_rms.push_back(residual.velocity_rms);
    row.residual_peak.push_back(residual.velocity_peak);
  }
  for (const FaultFinding& fault : d.faults) row.faults.push_back(event_of(fault));
  for (const ConditionItem& item : d.condition)
    if (item.is_determined())
      row.condition.push_back({item.name, item.value, (item.ci95[1] - item.value) / kNormal95, item.unit});
  return row;
}

BatchRow unusable_row(const std::string& name, const std::string& path, const Error& error,
                      const ModelFacts& model) {
  BatchRow row;
  row.log = valid_utf8(name);
  row.model = valid_utf8(model.name);
  row.model_sha256 = model.sha256;
  row.verdict = error.code() == ErrorCode::internal ? "failed" : "unusable";
  const std::string place = place_inside(error.where(), path);
  row.reason = brief(place.empty() ? error.message() : place + ": " + error.message());
  return row;
}

double residual_level(const BatchRow& row) {
  double level = std::numeric_limits<double>::quiet_NaN();
  for (const double rms : row.residual_rms)
    if (!(level >= rms) && !std::isnan(rms)) level = rms;
  return level;
}

std::string folder_of(const BatchRow& row) {
  const std::size_t end = row.log.rfind('/');
  return end == std::string::npos ? "" : row.log.substr(0, end);
}

int status_of(const BatchRow& row) {
  if (row.verdict == "failed") return 4;
  if (row.verdict == "unusable") return 3;
  return row.faults.empty() && row.verdict != "inconclusive" ? 0 : 1;
}

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
  v("score", row.score);
  v("residual_rms", row.residual_rms);
  v("residual_peak", row.residual_peak);
  v.as("condition", row.condition, condition_json, parameters_from);
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
         "rows_used,start_s,log_end_s,sample_period_s,warnings,severe,reason,report,log_sha256,model,model_sha256,doubt,"
         "score\n";
}

std::string to_csv_line(const BatchRow& row) {
  std::string all, first = ",,,,,";
  for (const FaultEvent& fault : row.faults) all += (all.empty() ? "" : ";") + fault_words(fault);
  if (!row.faults.empty()) {
    const FaultEvent& f = row.faults.front();
    first = fmt::format("{},{},{},{},{},{}", to_string(f.label.kind), csv_joint(f.label.joint),
                        csv_cell(f.onset_s), csv_cell(f.end_s), csv_cell(f.alarm_s), csv_cell(f.confidence));
  }
  return fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", csv_cell(row.log),
                     row.verdict, row.faults.size(), first, csv_cell(all), csv_cell(residual_level(row)),
                     row.rows, row.rows_used, csv_cell(row.start_s), csv_cell(row.end_s),
                     csv_cell(row.sample_period_s), row.warnings, row.severe, csv_cell(row.reason),
                     row.result.empty() ? "" : "logs/" + row.result + ".json", row.sha256,
                     csv_cell(row.model), row.model_sha256, csv_cell(row.doubt), csv_cell(row.score));
}

}  // namespace faultline
