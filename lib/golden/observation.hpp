// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "lib/diagnose/fault_event.hpp"
#include "lib/identify/identification.hpp"

namespace faultline {

/// The fault-free motion that a model predicts one step ahead, at some rows of a log.
struct Trace {
  std::vector<std::string> channels;        ///< q1 .. qn, dq1 .. dqn
  std::vector<double> time;                 ///< of the predicted row, s
  std::vector<std::vector<double>> values;  ///< [channel][point]; rad, m, rad/s, m/s; NaN = not predicted

  int points() const { return static_cast<int>(time.size()); }
};

/// CSV: t and the channels; numbers with nine significant digits, times in full, nan for a missing number.
std::string trace_to_csv(const Trace& trace);
/// Throws Error(input) for text that is no trace.
Trace trace_from_csv(const std::string& text, const std::string& where);

/// An event and what it rests on.
struct ObservedEvent : FaultEvent {
  double evidence = std::numeric_limits<double>::quiet_NaN();  ///< log likelihood ratio, nats
  std::string decided_by{};                                    ///< of DecidedBy
  Opinions opinions{};
  std::vector<FaultLabel> could_also_be{};
};

/// What one program version with one model says of one log: the part of a Diagnosis that golden logs compare,
/// and the motion that the model predicts.
struct Observation {
  std::string verdict;    ///< of Verdict, or "unusable": the log could not be processed
  std::string reason;     ///< why it is unusable; not compared
  std::int64_t rows = 0;  ///< used
  std::vector<ObservedEvent> events;
  std::vector<JointResidual> residuals;
  Trace trace;
};

inline constexpr const char* kUnusable = "unusable";

/// What identify() says of the healthy golden logs.
struct ObservedIdentification {
  std::string status;  ///< of IdentificationStatus, or "unusable"
  std::string method;
  std::vector<ParameterValue> parameters;
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
  std::vector<ParameterValue> model_values;  ///< values_of()
  std::vector<Log> logs;
  std::optional<ObservedIdentification> identification;
};

}  // namespace faultline
