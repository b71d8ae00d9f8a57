// SPDX-License-Identifier: MIT
#pragma once

#include "lib/cases/case_base.hpp"

namespace faultline {

/// Whether both cases are of one event: same log (SHA-256), onsets closer than those of two faults of one
/// robot, and same decision or same label. False if a log is not known.
bool is_same_event(const Case& a, const Case& b);

/// Returns the case of the base of the same event; null if there is none.
const Case* find_same_event(const CaseBase& base, const Case& c);

}  // namespace faultline
