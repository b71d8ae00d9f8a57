// SPDX-License-Identifier: MIT
#include "lib/report/model_facts.hpp"

#include <fmt/format.h>

#include <cmath>
#include <set>

#include "lib/core/number_text.hpp"

namespace faultline {

FactTable robot_facts(const Model& model) {
  const Identification& id = model.identification;
  FactTable table{"", {}, {}};
  table.rows.push_back({"robot", fmt::format("{} ({} joints)", model.name, model.robot.joints())});
  table.rows.push_back({"usual sample period", fact_text(model.sample_period_s, "s")});
  for (int j = 0; j < std::ssize(id.fit_r2); ++j)
    table.rows.push_back({fmt::format("joint {}: torque explained", Joint::at(j)),
                          fmt::format("{:.2f} %", 100.0 * id.fit_r2[j])});
  return table;
}

FactTable parameter_table(const Identification& identification) {
  FactTable table{fmt::format("Identified parameters ({})", to_string(identification.status)),
                  {"parameter", "value", "95 % interval", "unit", "remark"},
                  {}};
  for (const ParameterEstimate* p : listed_parameters(identification)) {
    const std::string interval =
        p->identifiable ? digits_text(p->ci95[0], 5) + " to " + digits_text(p->ci95[1], 5) : "-";
    table.rows.push_back(
        {p->name, fact_text(p->value), interval, p->unit, p->identifiable ? p->meaning : p->why_not});
  }
  return table;
}

std::vector<const ParameterEstimate*> listed_parameters(const Identification& identification) {
  std::vector<const ParameterEstimate*> listed;
  std::set<std::string> seen;
  for (const auto* list : {&identification.physical_parameters, &identification.base_parameters})
    for (const ParameterEstimate& p : *list)
      if (seen.insert(p.name).second) listed.push_back(&p);
  return listed;
}

FactTable validation_table(const Validation& validation) {
  FactTable table{"Tested on simulated runs that were not used for training",
                  {"fault", "runs", "found", "right joint", "right", "right or named", "median delay"},
                  {}};
  for (const ValidationRow& row : validation.rows) {
    std::vector<std::string> cells = validation_counts(row);
    cells.insert(cells.begin(), to_string(row.kind));
    cells.push_back(std::isfinite(row.median_delay_s) ? seconds_text(row.median_delay_s) : "-");
    table.rows.push_back(std::move(cells));
  }
  table.rows.push_back({"none (false alarms)", fmt::format("{:.2f} h", validation.healthy_hours),
                        std::to_string(validation.false_alarms), "", "", "", ""});
  return table;
}

std::vector<std::string> validation_counts(const ValidationRow& row) {
  std::vector<std::string> counts;
  for (const int count :
       {row.runs, row.detected, row.right_joint, row.right_kind_and_joint, row.right_or_named})
    counts.push_back(std::to_string(count));
  return counts;
}

FactTable source_table(const Model& model) {
  FactTable table{"Logs from which the model was learned", {"log", "rows", "fault", "SHA-256"}, {}};
  for (const ModelSource& source : model.sources)
    table.rows.push_back({source.path, std::to_string(source.rows), source.fault, source.sha256});
  return table;
}

}  // namespace faultline
