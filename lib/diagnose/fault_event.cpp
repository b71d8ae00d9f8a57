// SPDX-License-Identifier: MIT
#include "lib/diagnose/fault_event.hpp"

#include <nlohmann/json.hpp>

#include "lib/core/json_values.hpp"

namespace faultline {
namespace {

using Json = nlohmann::ordered_json;

}  // namespace

FaultEvent event_of(const FaultFinding& f) {
  return {f.label, f.onset_s, f.alarm_s, f.end_s, f.confidence, f.run, f.clock_offset_s};
}

std::vector<FaultEvent> events_of(const std::vector<FaultFinding>& findings) {
  std::vector<FaultEvent> events;
  for (const FaultFinding& finding : findings) events.push_back(event_of(finding));
  return events;
}

Json to_json(const FaultEvent& event) {
  Json json = {{"kind", to_string(event.label.kind)},      {"joint", count_or_null(event.label.joint)},
               {"onset_s", number_or_null(event.onset_s)}, {"alarm_s", number_or_null(event.alarm_s)},
               {"end_s", number_or_null(event.end_s)},     {"confidence", number_or_null(event.confidence)}};
  if (event.run > 0) {
    json["run"] = event.run;
    json["clock_offset_s"] = number_or_null(event.clock_offset_s);
  }
  return json;
}

FaultEvent fault_event_from_json(const Json& json) {
  const bool has_run = json.contains("run");
  return {{fault_kind_from(json.at("kind").get<std::string>()), count_or_zero(json.at("joint"))},
          number_or_nan(json.at("onset_s")),
          number_or_nan(json.at("alarm_s")),
          number_or_nan(json.at("end_s")),
          number_or_nan(json.at("confidence")),
          has_run ? json.at("run").get<int>() : 0,
          has_run ? number_or_nan(json.at("clock_offset_s")) : 0.0};
}

}  // namespace faultline
