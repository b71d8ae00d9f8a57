// SPDX-License-Identifier: MIT
#include "lib/diagnose/fault_event.hpp"

#include <nlohmann/json.hpp>

#include "lib/diagnose/fault_event_fields.hpp"

namespace faultline {

using Json = nlohmann::ordered_json;

FaultEvent event_of(const FaultFinding& f) {
  return {f.label, f.onset_s, f.alarm_s, f.end_s, f.confidence, f.run, f.clock_offset_s};
}

std::vector<FaultEvent> events_of(const std::vector<FaultFinding>& findings) {
  std::vector<FaultEvent> events;
  for (const FaultFinding& finding : findings) events.push_back(event_of(finding));
  return events;
}

Json to_json(const FaultEvent& event) { return fields_to_json<Json>(event); }

FaultEvent fault_event_from_json(const Json& json) { return fields_from_json<FaultEvent>(json, ""); }

}  // namespace faultline
