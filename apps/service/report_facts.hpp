// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/fault/fault_kind.hpp"

namespace faultline {

/// What the pages show of a fault in a report.
struct ReportedFault {
  int id = 0;
  FaultLabel label;
  double onset_s = 0.0;
  double confidence = 0.0;  ///< 0 to 1
  std::string next_check;
};

/// What the pages show of a report.
struct ReportFacts {
  std::string verdict, verdict_reason;
  double sample_period_s = 0.0;  ///< 0: unknown
  int joints = 0;
  std::vector<ReportedFault> faults;  ///< by onset
};

/// Reads the JSON of a diagnosis (schema faultline/diagnosis/1). Throws nlohmann::json::exception or Error
/// for other text.
ReportFacts report_facts(const std::string& json);

}  // namespace faultline
