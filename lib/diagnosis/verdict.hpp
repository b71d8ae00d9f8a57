// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/diagnosis/diagnosis.hpp"

namespace faultline {

/// The verdict on a log with its reason, and the faults that stand, merged and numbered: none where the log
/// cannot be judged.
/// `model_period_s` is the usual sample period of the logs that the model was learned from.
void settle_verdict(Diagnosis& diagnosis, std::vector<FaultFinding> faults, double model_period_s);

}  // namespace faultline
