// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "lib/fault/fault_kind.hpp"

namespace faultline {

/// An episode before the decision: the query of case-based reasoning.
struct Episode {
  std::vector<double> features;  ///< with the meaning of CaseBase::feature_names(); NaN = not measured
  Opinion mlp;
  Opinion rbfn;
  /// Log likelihood ratio of the best fault hypothesis to the healthy one; NaN if it was not computed.
  double evidence = std::numeric_limits<double>::quiet_NaN();
};

enum class CaseOutcome {
  unconfirmed,  ///< decided, and not yet judged right or wrong
  confirmed,    ///< judged right by a person or by the truth of a simulation
  rejected,     ///< judged wrong by a person; `label` is then the true label, if known
};
const char* to_string(CaseOutcome outcome);
/// Throws Error(usage) that lists the names if `name` is none of them.
CaseOutcome case_outcome_from(const std::string& name);

/// An episode with its decision and its outcome.
struct Case {
  std::int64_t id = 0;  ///< given by the case base, from 1
  Episode episode;
  FaultLabel decision;  ///< the decision when the episode was seen
  FaultLabel label;     ///< the true label as far as known: the decision until a person gives another
  CaseOutcome outcome = CaseOutcome::unconfirmed;
  std::string what_was_done;  ///< by the technician
  std::string origin;         ///< kSimulatedOrigin, kLabelledOrigin, a log's name, an import
  std::string log_sha256;     ///< SHA-256 of the log of the episode; empty if there is none
  double onset_s = std::numeric_limits<double>::quiet_NaN();  ///< in that log; NaN if not known
  /// Identity of the other model that computed the features; empty: the model of the base.
  std::string features_by;
  std::string log_name;  ///< file name of a labelled log; that of a diagnosed log is in `origin`
  std::string robot;     ///< robot of the episode; empty: the robot of the base
  std::string person;    ///< who added the case or last gave its label; empty if not known
  std::string date;      ///< when the person did, YYYY-MM-DD; empty if not known
};

/// The person who gives the label of a case, and the date; each may be empty.
struct Signature {
  std::string person{};
  std::string date{};  ///< YYYY-MM-DD
};

/// Origins of the cases that `learn` makes; it makes them again each time.
inline constexpr const char* kSimulatedOrigin = "simulated";
inline constexpr const char* kLabelledOrigin = "labelled log";
/// Origin of a case that was entered without a log.
inline constexpr const char* kByHandOrigin = "recorded by hand";

/// Origin of a case and of its label, the best first: the order in which reports list similar cases.
enum class CaseOrigin {
  field,      ///< seen on the robot in operation, with a label that a person gave
  labelled,   ///< from a log that was given to `learn` with its label
  diagnosed,  ///< seen on the robot in operation; labelled by this program only, or not known
  simulated,
};
/// Returns the name used in JSON and options, such as "field".
const char* to_string(CaseOrigin origin);
/// Throws Error(usage) that lists the names if `name` is none of them.
CaseOrigin case_origin_from(const std::string& name);

/// False if a person rejected the decision and did not say what it was.
bool fault_is_known(const Case& c);

CaseOrigin origin_of(const Case& c);

/// Whether people added the case: neither simulated nor of a labelled log.
bool is_of_field(const Case& c);

/// Returns the name of the log of the case; empty if there is none or it is not known.
std::string log_name_of(const Case& c);

/// Returns in words the origin of the case and of its label, such as "confirmed in the field by A. Weber on
/// 2026-03-02, robot bench 7, log night.csv". `robot` is the robot of the base.
std::string origin_words(const Case& c, const std::string& robot = "");

}  // namespace faultline
