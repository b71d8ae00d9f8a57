// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <string>
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

/// Returns the diagnosis with the verdict on its log, the reason, and the faults, merged and numbered: none
/// if the log cannot be judged. `model_period_s` is the usual sample period of the logs that the model was
/// learned from, `power` the share of simulated faults that it finds (NaN if not known): a model that finds
/// few faults cannot call a log healthy.
Diagnosis with_verdict(Diagnosis diagnosis, const std::vector<FaultFinding>& faults, double model_period_s,
                       double power = std::numeric_limits<double>::quiet_NaN());

}  // namespace faultline
