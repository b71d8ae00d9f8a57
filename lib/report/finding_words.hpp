// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "lib/diagnose/diagnosis.hpp"
#include "lib/report/fact_table.hpp"

/// Sentences that every report for people uses, so that none of them says something else.

namespace faultline {

/// Who settled what the fault is, such as "both networks agree".
const char* decided_words(const FaultFinding& fault);

/// Whether a network was asked at all.
inline bool was_asked(const Opinion& opinion) { return opinion.confidence > 0.0; }

/// How large the fault is, such as "about 50 % of the torque is lost"; empty when that was not estimated.
std::string size_words(const FaultFinding& fault);

/// A row of the table of faults: number, what, onset, alarm, end, confidence, who decided.
std::vector<std::string> fault_cells(const FaultFinding& fault, double sample_period_s);

/// Network, what it names and its confidence, a row a network; empty if neither was asked.
std::vector<std::vector<std::string>> opinion_rows(const FaultFinding& fault);
/// What else it could be and why, a line each; the evidence, likewise.
std::vector<std::string> alternative_lines(const FaultFinding& fault);
std::vector<std::string> evidence_lines(const FaultFinding& fault);

/// Joint, rms and largest velocity residual, when that was, rms position residual; a row a joint.
std::vector<std::vector<std::string>> residual_rows(const Diagnosis& diagnosis);

/// "warning (time_backward, 2 times in t, first in row 17, 2 rows left out): ...".
std::vector<std::string> issue_lines(const Issues& issues);

/// Heading and lines of what was found and is too small to be reported as a fault.
inline constexpr const char* kSmallChangesTitle = "Changes too small to be reported as faults";
std::vector<std::string> small_change_lines(const Diagnosis& diagnosis);

/// "Similar cases", and what all of them are where none was confirmed in the field.
std::string precedents_title(const FaultFinding& fault);

/// Similar cases by origin: those of a person or of labelled logs, and those that were simulated.
std::vector<Precedent> known_precedents(const FaultFinding& fault);
std::vector<Precedent> simulated_precedents(const FaultFinding& fault);
/// "7 simulated cases, the most similar is case 10 (0.93): joint 1 is locked"; empty without any.
std::string simulated_precedents_words(const FaultFinding& fault);

/// Value of a feature with its unit, such as "12 times healthy".
std::string feature_value_text(double value, const std::string& unit);

/// "alike: MLP residual of joint 2 (here 12, there 14 times healthy); unlike: ...", at most `most` of each;
/// empty where nothing was compared.
std::string likeness_words(const Precedent& precedent, std::size_t most);

/// Number, similarity, fault, origin, action taken.
std::vector<std::string> precedent_cells(const Precedent& precedent);
/// "12 field 0.83", as in the table for programs.
std::string precedent_code(const Precedent& precedent);

/// Table of the effects of the day that the log determines, one row each; empty if it determines none.
FactTable condition_table(const Diagnosis& diagnosis);

}  // namespace faultline
