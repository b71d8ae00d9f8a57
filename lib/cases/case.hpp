// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "lib/fault/opinion.hpp"

namespace faultline {

/// What is known of an episode before it is decided: the query of case-based reasoning.
struct Episode {
  std::vector<double> features;  ///< with the meaning of CaseBase::feature_names(); NaN = not measured
  Opinion mlp;
  Opinion rbfn;
  /// Log likelihood of the best fault hypothesis over the healthy one; NaN when it was not computed.
  double evidence = std::numeric_limits<double>::quiet_NaN();
};

enum class CaseOutcome {
  unconfirmed,  ///< decided, nobody has said yet whether it was right
  confirmed,    ///< a person or the truth of a simulation says it was
  rejected,     ///< a person says it was not; `label` then holds what it was, if known
};
const char* to_string(CaseOutcome outcome);
/// Throws Error(usage) that lists the names when `name` is none of them.
CaseOutcome case_outcome_from(const std::string& name);

/// An episode with its decision and what came of it.
struct Case {
  std::int64_t id = 0;  ///< given by the case base, from 1
  Episode episode;
  FaultLabel decision;  ///< what was decided when the episode was seen
  FaultLabel label;     ///< what it was as far as is known: the decision until a person says otherwise
  CaseOutcome outcome = CaseOutcome::unconfirmed;
  std::string what_was_done;  ///< by the technician
  std::string origin;         ///< kSimulatedOrigin, kLabelledOrigin, a log's name, an import
  std::string log_sha256;     ///< of the log that it was seen in; empty where that is not known
  double onset_s = std::numeric_limits<double>::quiet_NaN();  ///< in that log; NaN where it is not known
  /// Identity of the other model that the features were computed with; empty: of the model of the base.
  std::string features_by;
  std::string log_name;  ///< of a labelled log; of what was diagnosed, `origin` tells it
  std::string robot;     ///< that it was seen on; empty: the robot of the base, or not known
  std::string person;    ///< who added it, or said last what it was; empty where that is not told
  std::string date;      ///< when, YYYY-MM-DD; empty where that is not told
};

/// Who says something of a case, and when; each may be empty.
struct Signature {
  std::string person{};
  std::string date{};  ///< YYYY-MM-DD
};

/// What `learn` says of the cases that it makes; they are made anew each time.
inline constexpr const char* kSimulatedOrigin = "simulated";
inline constexpr const char* kLabelledOrigin = "labelled log";
/// Of a case that was told without a log.
inline constexpr const char* kByHandOrigin = "recorded by hand";

}  // namespace faultline
