// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "lib/diagnosis/diagnosis.hpp"

namespace faultline {

/// A finding as an event of a log: what an index of many logs and a golden log hold of it.
struct FaultEvent {
  FaultLabel label;
  double onset_s = std::numeric_limits<double>::quiet_NaN();
  double alarm_s = std::numeric_limits<double>::quiet_NaN();
  double end_s = std::numeric_limits<double>::quiet_NaN();
  double confidence = 0.0;  ///< 0 to 1
};

FaultEvent event_of(const FaultFinding& finding);
/// In the order of the findings.
std::vector<FaultEvent> events_of(const std::vector<FaultFinding>& findings);

/// With null for a number that is not finite and for the joint of a fault that belongs to none.
nlohmann::ordered_json to_json(const FaultEvent& event);
/// Throws nlohmann::json::exception when a key is missing or of another type, Error for an unknown kind.
FaultEvent fault_event_from_json(const nlohmann::ordered_json& json);

}  // namespace faultline
