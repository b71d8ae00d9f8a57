// SPDX-License-Identifier: MIT
#include "lib/report/finding_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/core/number_text.hpp"
#include "lib/core/text.hpp"
#include "lib/diagnose/least_size.hpp"

namespace faultline {
namespace {

bool only_simulated_voted(const FaultFinding& fault) {
  return std::all_of(fault.precedents.begin(), fault.precedents.end(),
                     [](const Precedent& p) { return !p.voted || p.origin == CaseOrigin::simulated; });
}

}  // namespace

const char* decided_words(const FaultFinding& fault) {
  switch (fault.decided_by) {
    case DecidedBy::agreement:
      return "both networks agree";
    case DecidedBy::cases:
      if (fault.precedents.empty()) return "the networks disagree and no similar case is known";
      return only_simulated_voted(fault) ? "the networks disagree; similar simulated cases decided"
                                         : "the networks disagree; similar cases decided";
    case DecidedBy::evidence:
      return "the physical evidence decided";
    case DecidedBy::criterion:
      return "the networks' fault criterion decided";
    case DecidedBy::actuator:
      return "the difference of measured and commanded torque decided";
    case DecidedBy::control_law:
      return "the difference of commanded torque and control law decided";
    case DecidedBy::tracking:
      return "the difference of motion and reference decided";
    case DecidedBy::abstained:
      return "not named: the evidence is too weak";
  }
  return "";
}

std::string evidence_line(const EvidenceItem& e) {
  if (std::isnan(e.value)) return e.name == "decision" || e.text.empty() ? e.text : e.name + ": " + e.text;
  const std::string value = value_text(e.value) + (e.unit.empty() ? "" : " " + e.unit);
  return (e.text.empty() ? e.name : e.text) + ": " + value;
}

std::string size_words(const FaultFinding& fault) {
  const auto size = std::find_if(fault.evidence.begin(), fault.evidence.end(),
                                 [](const EvidenceItem& item) { return item.name == "size"; });
  return size == fault.evidence.end() ? "" : size->text;
}

std::string issue_line(const Issue& issue) {
  std::string where = issue.channel.empty() ? "" : " in " + shortened(issue.channel, kLongestName);
  if (issue.first_row > 0) where += fmt::format(", first in row {}", issue.first_row);
  const std::string dropped =
      issue.rows_dropped > 0 ? fmt::format(", {} rows left out", issue.rows_dropped) : "";
  return fmt::format("{} ({}, {} times{}{}): {}", to_string(issue.severity), issue.code, issue.count, where,
                     dropped, issue.message);
}

std::vector<std::string> small_change_lines(const Diagnosis& diagnosis) {
  std::vector<std::string> lines;
  for (const FaultFinding& change : diagnosis.small_changes)
    lines.push_back(small_change_text(change, diagnosis.log.sample_period_s));
  return lines;
}

}  // namespace faultline
