// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lib/fault/fault_kind.hpp"

namespace faultline {

/// The kind in words a technician uses, such as "swings freely (no torque)".
const char* plain_name(FaultKind kind);

/// Kind and joint in words, such as "joint 2 swings freely (no torque)" or "an unknown fault".
std::string plain_words(const FaultLabel& label);

/// What to look at next, one or two sentences addressed to a technician.
std::string next_check_for(const FaultLabel& label);

/// Why two faults are hard to tell apart on a joint log, or empty when nothing speaks for confusing them
/// (which pairs: the observability of rigid-body joint logs, docs/report.md).
std::string why_alike(const FaultLabel& a, const FaultLabel& b);

}  // namespace faultline
