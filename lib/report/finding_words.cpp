// SPDX-License-Identifier: MIT
#include "lib/report/finding_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/core/number_text.hpp"
#include "lib/core/text.hpp"
#include "lib/diagnose/fault_event.hpp"
#include "lib/diagnose/least_size.hpp"
#include "lib/fault/fault_catalogue.hpp"

namespace faultline {
namespace {

bool only_simulated_voted(const FaultFinding& fault) {
  return std::all_of(fault.precedents.begin(), fault.precedents.end(),
                     [](const Precedent& p) { return !p.voted || p.origin == CaseOrigin::simulated; });
}

bool has(const FaultFinding& fault, CaseOrigin origin) {
  return std::any_of(fault.precedents.begin(), fault.precedents.end(),
                     [origin](const Precedent& p) { return p.origin == origin; });
}

std::string words(const PrecedentFeature& f) {
  return fmt::format("{} (here {}, there {})", f.what, value_text(f.here),
                     feature_value_text(f.there, f.unit));
}

std::string list(const std::vector<PrecedentFeature>& features, std::size_t most) {
  std::string text;
  for (std::size_t i = 0; i < std::min(most, features.size()); ++i)
    text += (i == 0 ? "" : ", ") + words(features[i]);
  return text;
}

template <typename Items, typename Line>
std::vector<std::string> lines_of(const Items& items, Line line) {
  std::vector<std::string> lines;
  for (const auto& item : items) lines.push_back(line(item));
  return lines;
}

/// "MLP residual of joint 2: 41.5 times healthy".
std::string evidence_line(const EvidenceItem& e) {
  if (std::isnan(e.value)) return e.name == "decision" || e.text.empty() ? e.text : e.name + ": " + e.text;
  const std::string value = value_text(e.value) + (e.unit.empty() ? "" : " " + e.unit);
  return (e.text.empty() ? e.name : e.text) + ": " + value;
}

std::string issue_line(const Issue& issue) {
  std::string where = issue.channel.empty() ? "" : " in " + shortened(issue.channel, kLongestName);
  if (issue.first_row > 0) where += fmt::format(", first in row {}", issue.first_row);
  const std::string dropped =
      issue.rows_dropped > 0 ? fmt::format(", {} rows left out", issue.rows_dropped) : "";
  return fmt::format("{} ({}, {} times{}{}): {}", to_string(issue.severity), issue.code, issue.count, where,
                     dropped, issue.message);
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

std::string size_words(const FaultFinding& fault) {
  const auto size = std::find_if(fault.evidence.begin(), fault.evidence.end(),
                                 [](const EvidenceItem& item) { return item.name == "size"; });
  return size == fault.evidence.end() ? "" : size->text;
}

std::vector<std::string> fault_cells(const FaultFinding& f, double period_s) {
  return {std::to_string(f.id),
          plain_words(f.label),
          onset_words(f, period_s),
          clock_words(f, f.alarm_s, period_s),
          clock_words(f, f.end_s, period_s),
          percent_text(f.confidence),
          decided_words(f)};
}

std::vector<std::vector<std::string>> opinion_rows(const FaultFinding& f) {
  if (!was_asked(f.mlp) && !was_asked(f.rbfn)) return {};
  return {{"MLP", plain_words(f.mlp.label), fmt::format("{:.2f}", f.mlp.confidence)},
          {"RBFN", plain_words(f.rbfn.label), fmt::format("{:.2f}", f.rbfn.confidence)}};
}

std::vector<std::string> alternative_lines(const FaultFinding& fault) {
  return lines_of(fault.could_also_be,
                  [](const Alternative& a) { return plain_words(a.label) + ": " + a.why; });
}

std::vector<std::string> evidence_lines(const FaultFinding& fault) {
  return lines_of(fault.evidence, evidence_line);
}

std::vector<std::vector<std::string>> residual_rows(const Diagnosis& d) {
  std::vector<std::vector<std::string>> rows;
  for (const JointResidual& r : d.residuals)
    rows.push_back({fmt::format("{}", r.joint), value_text(r.velocity_rms), value_text(r.velocity_peak),
                    time_text(r.velocity_peak_s, d.log.sample_period_s), value_text(r.position_rms)});
  return rows;
}

std::vector<std::string> issue_lines(const Issues& issues) { return lines_of(issues.all(), issue_line); }

std::vector<std::string> small_change_lines(const Diagnosis& diagnosis) {
  return lines_of(diagnosis.small_changes, [&](const FaultFinding& change) {
    return small_change_text(change, diagnosis.log.sample_period_s);
  });
}

std::string precedents_title(const FaultFinding& fault) {
  if (fault.precedents.empty() || has(fault, CaseOrigin::field)) return "Similar cases";
  if (has(fault, CaseOrigin::labelled) || has(fault, CaseOrigin::diagnosed))
    return "Similar cases (none confirmed in the field)";
  return "Similar cases (all simulated, none seen in the field)";
}

std::vector<Precedent> known_precedents(const FaultFinding& fault) {
  std::vector<Precedent> known;
  for (const Precedent& p : fault.precedents)
    if (p.origin != CaseOrigin::simulated) known.push_back(p);
  return known;
}

std::vector<Precedent> simulated_precedents(const FaultFinding& fault) {
  std::vector<Precedent> simulated;
  for (const Precedent& p : fault.precedents)
    if (p.origin == CaseOrigin::simulated) simulated.push_back(p);
  return simulated;
}

std::string simulated_precedents_words(const FaultFinding& fault) {
  const std::vector<Precedent> simulated = simulated_precedents(fault);
  if (simulated.empty()) return "";
  const auto nearest =
      std::max_element(simulated.begin(), simulated.end(),
                       [](const Precedent& a, const Precedent& b) { return a.similarity < b.similarity; });
  return fmt::format("{} simulated with the robot's model, the most similar is case {} ({:.2f}): {}",
                     counted(std::ssize(simulated), "case"), nearest->case_id, nearest->similarity,
                     plain_words(nearest->label));
}

std::string feature_value_text(double value, const std::string& unit) {
  return value_text(value) + (unit.empty() ? "" : " " + unit);
}

std::string likeness_words(const Precedent& precedent, std::size_t most) {
  if (precedent.alike.empty() && precedent.unlike.empty()) return "";
  const std::string alike = list(precedent.alike, most), unlike = list(precedent.unlike, most);
  return "alike: " + (alike.empty() ? "no outstanding feature" : alike) + "; unlike: " +
         (unlike.empty() ? "nothing beyond the usual difference of cases of one fault" : unlike);
}

std::vector<std::string> precedent_cells(const Precedent& p) {
  const auto or_dash = [](const std::string& text) { return text.empty() ? std::string("-") : text; };
  return {std::to_string(p.case_id), fmt::format("{:.2f}", p.similarity), plain_words(p.label),
          or_dash(p.origin_text), or_dash(p.what_was_done)};
}

std::string precedent_code(const Precedent& precedent) {
  return fmt::format("{} {} {:.2f}", precedent.case_id, to_string(precedent.origin), precedent.similarity);
}

FactTable condition_table(const Diagnosis& diagnosis) {
  FactTable table{"Condition: differences from the identified robot, no fault by themselves",
                  {"what", "difference", "95 % interval", "normal within", ""},
                  {}};
  for (const ConditionItem& item : diagnosis.condition)
    if (item.is_determined())
      table.rows.push_back({item.what, condition_value_text(item.value, item.unit),
                            fmt::format("{} to {}", value_text(item.ci95[0]), value_text(item.ci95[1])),
                            fmt::format("{} {}", digits_text(item.normal_range, 2), item.unit),
                            item.is_beyond() ? "beyond" : ""});
  return table;
}

}  // namespace faultline
