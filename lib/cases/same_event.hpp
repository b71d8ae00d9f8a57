// SPDX-License-Identifier: MIT
#pragma once

#include "lib/cases/case_base.hpp"

namespace faultline {

/// Whether both cases tell of one event: the same log (its SHA-256), onsets that no two faults of one robot
/// have so near each other, and the same name, as decided or as what it was. False where a log is not known.
bool is_same_event(const Case& a, const Case& b);

/// The case of the base that tells of that event; null when none does.
const Case* find_same_event(const CaseBase& base, const Case& c);

}  // namespace faultline
