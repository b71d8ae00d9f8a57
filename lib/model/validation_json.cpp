// SPDX-License-Identifier: MIT
#include "lib/model/validation_json.hpp"

#include <nlohmann/json.hpp>

#include "lib/core/json_values.hpp"

namespace faultline {

nlohmann::json validation_to_json(const Validation& validation) {
  nlohmann::json rows = nlohmann::json::array();
  for (const ValidationRow& row : validation.rows)
    rows.push_back({{"kind", to_string(row.kind)},
                    {"runs", row.runs},
                    {"detected", row.detected},
                    {"right_kind", row.right_kind},
                    {"right_joint", row.right_joint},
                    {"right_kind_and_joint", row.right_kind_and_joint},
                    {"right_or_named", row.right_or_named},
                    {"median_delay_s", number_or_null(row.median_delay_s)},
                    {"p90_delay_s", number_or_null(row.p90_delay_s)}});
  nlohmann::json reach = nlohmann::json::array();
  for (const Reach& each : validation.reach)
    reach.push_back({{"kind", to_string(each.label.kind)},
                     {"joint", each.label.joint},
                     {"runs", each.runs},
                     {"found", each.found},
                     {"size", number_or_null(each.size)},
                     {"least_size", number_or_null(each.least_size)},
                     {"median_delay_s", number_or_null(each.median_delay_s)}});
  return {{"rows", rows},
          {"reach", reach},
          {"early_alarms", validation.early_alarms},
          {"healthy_hours", validation.healthy_hours},
          {"false_alarms", validation.false_alarms},
          {"raw_confidence_error", number_or_null(validation.raw_confidence_error)},
          {"confidence_error", number_or_null(validation.confidence_error)}};
}

Validation validation_from_json(const nlohmann::json& json) {
  Validation validation;
  for (const auto& row : json.at("rows"))
    validation.rows.push_back({fault_kind_from(row.at("kind")), row.at("runs"), row.at("detected"),
                               row.at("right_kind"), row.at("right_joint"), row.at("right_kind_and_joint"),
                               row.at("right_or_named"), number_or_nan(row.at("median_delay_s")),
                               number_or_nan(row.at("p90_delay_s"))});
  if (json.contains("reach"))
    for (const auto& each : json["reach"])
      validation.reach.push_back({{fault_kind_from(each.at("kind")), each.at("joint")},
                                  each.at("runs"),
                                  each.at("found"),
                                  number_or_nan(each.at("size")),
                                  number_or_nan(each.at("least_size")),
                                  number_or_nan(each.at("median_delay_s"))});
  validation.early_alarms = json.at("early_alarms");
  validation.healthy_hours = json.at("healthy_hours");
  validation.false_alarms = json.at("false_alarms");
  validation.raw_confidence_error = number_or_nan(json.at("raw_confidence_error"));
  validation.confidence_error = number_or_nan(json.at("confidence_error"));
  return validation;
}

}  // namespace faultline
