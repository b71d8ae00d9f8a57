// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/diagnose/diagnosis.hpp"

namespace faultline {

/// Merges findings that are parts of one fault: the same kind at the same joint that begins again within a
/// second, or a collision at its joint when it ends, extends a lasting fault; collisions during and right
/// after an unknown disturbance are part of it, and one right before is its onset; a short unknown
/// disturbance or collision right before a lasting fault is the onset of that fault. Findings of the
/// criterion over single samples, of actuators and of control laws are not merged.
std::vector<FaultFinding> merge_continued(std::vector<FaultFinding> faults);

/// Returns the findings by onset (then alarm, then joint), unknown times last, with ids from 1.
std::vector<FaultFinding> numbered_by_onset(std::vector<FaultFinding> faults);

}  // namespace faultline
