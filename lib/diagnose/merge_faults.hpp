// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/diagnose/diagnosis.hpp"

namespace faultline {

/// A fault that pauses is one finding: the same kind at the same joint that begins again within a second
/// extends it, and so does a push at its joint when it ends. Likewise a push right before an unknown
/// disturbance is its beginning, and pushes right after are part of it, and what shakes for a moment before a
/// lasting fault is named is its onset. What the criterion over single samples or a second residual found
/// stays as it was cut.
std::vector<FaultFinding> merge_continued(std::vector<FaultFinding> faults);

/// Findings by onset (then alarm, then joint), unknown times last, with ids from 1.
void number_by_onset(std::vector<FaultFinding>& faults);

}  // namespace faultline
