// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "lib/diagnosis/diagnosis.hpp"
#include "lib/golden/trace.hpp"

namespace faultline {

/// What a golden log holds of a finding.
struct GoldenEvent {
  FaultLabel label;
  double onset_s = std::numeric_limits<double>::quiet_NaN();
  double alarm_s = std::numeric_limits<double>::quiet_NaN();
  double end_s = std::numeric_limits<double>::quiet_NaN();
  double confidence = 0.0;
};

/// What one program version with one model says of one log: the part of a Diagnosis that golden logs compare,
/// and the motion that the model foretells.
struct Observation {
  std::string verdict;    ///< of Verdict, or "unusable": the log could not be processed
  std::string reason;     ///< why it is unusable; not compared
  std::int64_t rows = 0;  ///< used
  std::vector<GoldenEvent> events;
  std::vector<JointResidual> residuals;
  Trace trace;
};

inline constexpr const char* kUnusable = "unusable";

struct ObservedParameter {
  std::string name;
  double value = std::numeric_limits<double>::quiet_NaN();
  double std = std::numeric_limits<double>::quiet_NaN();  ///< NaN when not identifiable
  std::string unit;
};

/// What identify() says of the healthy golden logs.
struct ObservedIdentification {
  std::string status;  ///< of IdentificationStatus, or "unusable"
  std::string method;
  std::vector<ObservedParameter> parameters;
  std::string reason;  ///< why it is unusable; not compared
};

/// Everything that one program version and model say of a golden folder. Written by golden check --json.
struct GoldenRun {
  struct Log {
    std::string name;
    Observation observation;
  };

  std::string program_version;
  ModelFacts model;
  std::vector<Log> logs;
  std::optional<ObservedIdentification> identification;
};

}  // namespace faultline
