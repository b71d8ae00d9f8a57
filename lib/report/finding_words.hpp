// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lib/diagnose/diagnosis.hpp"

/// Sentences that every report for people uses, so that none of them says something else.
namespace faultline {

/// Who settled what the fault is, such as "both networks agree".
const char* decided_words(const FaultFinding& fault);

/// Whether a network was asked at all.
inline bool was_asked(const Opinion& opinion) { return opinion.confidence > 0.0; }

/// "MLP residual of joint 2: 41.5 times healthy".
std::string evidence_line(const EvidenceItem& item);

/// How large the fault is, such as "about 50 % of the torque is lost"; empty when that was not estimated.
std::string size_words(const FaultFinding& fault);

/// "warning (time_backward, 2 times in t, first in row 17, 2 rows left out): ...".
std::string issue_line(const Issue& issue);

/// Heading and lines of what was found and is too small to be reported as a fault.
inline constexpr const char* kSmallChangesTitle = "Changes too small to be reported as faults";
std::vector<std::string> small_change_lines(const Diagnosis& diagnosis);

}  // namespace faultline
