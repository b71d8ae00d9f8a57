// SPDX-License-Identifier: MIT
#include "lib/diagnosis/fault_event.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

namespace faultline {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

double number_in(const Json& json) {
  return json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();
}

}  // namespace

std::vector<FaultEvent> events_of(const std::vector<FaultFinding>& findings) {
  std::vector<FaultEvent> events;
  for (const FaultFinding& f : findings)
    events.push_back({f.label, f.onset_s, f.alarm_s, f.end_s, f.confidence});
  return events;
}

Json to_json(const FaultEvent& event) {
  return {{"kind", to_string(event.label.kind)},
          {"joint", event.label.joint > 0 ? Json(event.label.joint) : Json(nullptr)},
          {"onset_s", number(event.onset_s)},
          {"alarm_s", number(event.alarm_s)},
          {"end_s", number(event.end_s)},
          {"confidence", number(event.confidence)}};
}

FaultEvent fault_event_from_json(const Json& json) {
  const Json& joint = json.at("joint");
  return {{fault_kind_from(json.at("kind").get<std::string>()), joint.is_null() ? 0 : joint.get<int>()},
          number_in(json.at("onset_s")),
          number_in(json.at("alarm_s")),
          number_in(json.at("end_s")),
          number_in(json.at("confidence"))};
}

}  // namespace faultline
