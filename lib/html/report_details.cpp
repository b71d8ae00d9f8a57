// SPDX-License-Identifier: MIT
#include "lib/html/report_details.hpp"

#include <fmt/format.h>

#include <cmath>
#include <set>

#include "lib/core/number_text.hpp"
#include "lib/replay/run_curves.hpp"

namespace faultline {
namespace {

std::string number(double value, const char* unit = "") {
  return std::isfinite(value) ? digits_text(value, 5) + (*unit ? " " : "") + unit : "-";
}

FactTable parameter_table(const Identification& identification) {
  FactTable table{fmt::format("Identified parameters ({})", to_string(identification.status)),
                  {"parameter", "value", "95 % interval", "unit", "remark"},
                  {}};
  std::set<std::string> seen;
  for (const auto* list : {&identification.physical_parameters, &identification.base_parameters})
    for (const ParameterEstimate& p : *list) {
      if (!seen.insert(p.name).second) continue;
      const std::string interval =
          p.identifiable ? digits_text(p.ci95[0], 5) + " to " + digits_text(p.ci95[1], 5) : "-";
      table.rows.push_back(
          {p.name, number(p.value), interval, p.unit, p.identifiable ? p.meaning : p.why_not});
    }
  return table;
}

FactTable validation_table(const Validation& validation) {
  FactTable table{"Tested on simulated runs that nothing was trained on",
                  {"fault", "runs", "found", "right joint", "right", "right or named", "median delay"},
                  {}};
  for (const ValidationRow& row : validation.rows)
    table.rows.push_back({to_string(row.kind), std::to_string(row.runs), std::to_string(row.detected),
                          std::to_string(row.right_joint), std::to_string(row.right_kind_and_joint),
                          std::to_string(row.right_or_named),
                          std::isfinite(row.median_delay_s) ? seconds_text(row.median_delay_s) : "-"});
  table.rows.push_back({"none (false alarms)", fmt::format("{:.2f} h", validation.healthy_hours),
                        std::to_string(validation.false_alarms), "", "", "", ""});
  return table;
}

FactTable model_facts(const Model& model) {
  const Identification& id = model.identification;
  FactTable table{"", {}, {}};
  table.rows.push_back({"robot", fmt::format("{} ({} joints)", model.name, model.robot.joints())});
  table.rows.push_back({"usual sample period", number(model.sample_period_s, "s")});
  for (std::size_t j = 0; j < id.fit_r2.size(); ++j)
    table.rows.push_back(
        {fmt::format("joint {}: torque explained", j + 1), fmt::format("{:.2f} %", 100.0 * id.fit_r2[j])});
  return table;
}

FactTable source_table(const Model& model) {
  FactTable table{"Logs the model was learned from", {"log", "rows", "fault", "SHA-256"}, {}};
  for (const ModelSource& source : model.sources)
    table.rows.push_back({source.path, std::to_string(source.rows), source.fault, source.sha256});
  return table;
}

FactTable option_table(const Model& model, const DiagnoseOptions& options) {
  FactTable table{"Options", {}, {}};
  const bool samples = options.mode == ClassifyMode::samples;
  table.rows.push_back({"--classify", samples ? "samples" : "evidence"});
  if (samples) {
    table.rows.push_back(
        {"--criterion", options.criterion == CriterionKind::consecutive ? "consecutive" : "log_odds"});
    table.rows.push_back({"--g", options.g > 0 ? std::to_string(options.g) : "0 (as tuned by learn)"});
  }
  table.rows.push_back({"alarm threshold", number(model.evidence.threshold, "nats")});
  table.rows.push_back({"trigger", number(model.evidence.trigger, "standard deviations")});
  return table;
}

}  // namespace

ReportDetails report_details(LogSource& log, const Model& model, const Diagnosis& diagnosis,
                             const DiagnoseOptions& options) {
  ReportDetails details;
  details.curves = run_curves(log, model, diagnosis);
  details.model = {model_facts(model)};
  if (model.identification.status != IdentificationStatus::not_run)
    details.model.push_back(parameter_table(model.identification));
  details.model.push_back(validation_table(model.validation));
  details.provenance = {option_table(model, options), source_table(model)};
  return details;
}

}  // namespace faultline
