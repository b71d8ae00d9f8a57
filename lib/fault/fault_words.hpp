// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>

#include "lib/fault/fault_catalogue.hpp"

namespace faultline {

/// The kind in words a technician uses, such as "swings freely (no torque)".
const char* plain_name(FaultKind kind);

/// Kind and joint in words, such as "joint 2 swings freely (no torque)" or "an unknown fault".
std::string plain_words(const FaultLabel& label);

/// What to look at next, one or two sentences addressed to a technician.
std::string next_check_for(const FaultLabel& label);

/// How large the fault is, such as "about 40 % of the torque is lost"; empty for kinds whose size says
/// nothing. `sizes` as in the catalogue, at a joint that turns or slides.
std::string size_text(const FaultLabel& label, const std::array<double, kMostSizes>& sizes, bool turns);

/// Why two faults are hard to tell apart on a joint log, or empty when nothing speaks for confusing them
/// (which pairs: the observability of rigid-body joint logs, docs/report.md).
std::string why_alike(const FaultLabel& a, const FaultLabel& b);

}  // namespace faultline
