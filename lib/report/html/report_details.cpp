// SPDX-License-Identifier: MIT
#include "lib/report/html/report_details.hpp"

#include "lib/diagnose/curves/run_curves.hpp"
#include "lib/report/model_facts.hpp"

namespace faultline {
namespace {

FactTable option_table(const Model& model, const DiagnoseOptions& options) {
  FactTable table{"Options", {}, {}};
  table.rows.push_back({"--classify", to_string(options.mode)});
  if (options.mode == ClassifyMode::samples) {
    table.rows.push_back({"--criterion", to_string(options.criterion)});
    table.rows.push_back({"--g", options.g > 0 ? std::to_string(options.g) : "0 (as tuned by learn)"});
  }
  table.rows.push_back({"least alarm threshold", fact_text(least_limit(model.explain.limits), "nats")});
  return table;
}

}  // namespace

ReportDetails report_details(LogSource& log, const Model& model, const Diagnosis& diagnosis,
                             const DiagnoseOptions& options) {
  ReportDetails details;
  details.curves = run_curves(log, model, diagnosis);
  details.model = {robot_facts(model)};
  if (model.identification.status != IdentificationStatus::not_run)
    details.model.push_back(parameter_table(model.identification));
  if (!model.validation.rows.empty()) details.model.push_back(validation_table(model.validation));
  details.provenance = {option_table(model, options), source_table(model)};
  return details;
}

}  // namespace faultline
