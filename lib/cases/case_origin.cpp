// SPDX-License-Identifier: MIT
#include "lib/cases/case_origin.hpp"

#include "lib/core/error.hpp"
#include "lib/fault/fault_words.hpp"

namespace faultline {
namespace {

/// Returns " by A. Weber on 2026-03-02", without the parts that are not known.
std::string signature_words(const Case& c) {
  return (c.person.empty() ? "" : " by " + c.person) + (c.date.empty() ? "" : " on " + c.date);
}

/// Returns the signature, or words that it is not known.
std::string signed_words(const Case& c) {
  const std::string words = signature_words(c);
  return words.empty() ? ", author and date not recorded" : words;
}

std::string seen_words(const Case& c, const std::string& robot) {
  const std::string& name = c.robot.empty() ? robot : c.robot;
  const std::string log = log_name_of(c);
  return (name.empty() ? "" : ", robot " + name) +
         (log.empty() ? (c.origin == kByHandOrigin ? ", recorded by hand without a log" : "")
                      : ", log " + log);
}

std::string revision_words(const Case& c) {
  if (c.outcome == CaseOutcome::rejected) return ", rejected" + signature_words(c);
  return signature_words(c).empty() ? "" : ", confirmed" + signature_words(c);
}

std::string learned_words(const Case& c) {
  if (c.origin == kLabelledOrigin) {
    return "labelled log " + c.log_name + (c.robot.empty() ? "" : ", robot " + c.robot);
  }
  if (!c.robot.empty()) return "simulated with the model of robot " + c.robot;
  return c.features_by.empty() ? "simulated with the robot's model" : "simulated with another model";
}

std::string field_words(const Case& c) {
  const std::string called = " (was called: " + plain_words(c.decision) + ")";
  if (c.outcome == CaseOutcome::confirmed)
    return "confirmed in the field" + signed_words(c) + (c.label == c.decision ? "" : called);
  if (c.outcome == CaseOutcome::unconfirmed)
    return "diagnosed, not confirmed" +
           (signature_words(c).empty() ? "" : " (added" + signature_words(c) + ")");
  const char* const word = c.label.kind == FaultKind::unknown ? "rejected" : "corrected";
  return word + (" in the field" + signed_words(c)) + called;
}

}  // namespace

const char* to_string(CaseOrigin origin) {
  switch (origin) {
    case CaseOrigin::field:
      return "field";
    case CaseOrigin::labelled:
      return "labelled";
    case CaseOrigin::diagnosed:
      return "diagnosed";
    case CaseOrigin::simulated:
      return "simulated";
  }
  return "simulated";
}

CaseOrigin case_origin_from(const std::string& name) {
  for (const auto origin :
       {CaseOrigin::field, CaseOrigin::labelled, CaseOrigin::diagnosed, CaseOrigin::simulated})
    if (name == to_string(origin)) return origin;
  throw Error(ErrorCode::usage, "origin",
              "\"" + name + "\" is not an origin; expected one of field, labelled, diagnosed, simulated");
}

bool is_of_field(const Case& c) { return c.origin != kSimulatedOrigin && c.origin != kLabelledOrigin; }

CaseOrigin origin_of(const Case& c) {
  if (c.origin == kSimulatedOrigin) return CaseOrigin::simulated;
  if (c.origin == kLabelledOrigin) return CaseOrigin::labelled;
  const bool is_from_a_person = c.outcome == CaseOutcome::confirmed ||
                                (c.outcome == CaseOutcome::rejected && c.label.kind != FaultKind::unknown);
  return is_from_a_person ? CaseOrigin::field : CaseOrigin::diagnosed;
}

std::string log_name_of(const Case& c) {
  if (!c.log_name.empty()) return c.log_name;
  return is_of_field(c) && c.origin != kByHandOrigin ? c.origin : "";
}

std::string origin_words(const Case& c, const std::string& robot) {
  std::string words =
      is_of_field(c) ? field_words(c) + seen_words(c, robot) : learned_words(c) + revision_words(c);
  if (!c.features_by.empty() && origin_of(c) != CaseOrigin::simulated)
    words += ", compared by features of another model";
  return words;
}

}  // namespace faultline
