// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "lib/diagnose/diagnosis.hpp"

namespace faultline {

/// Sets the verdict on a log with its reason, and the faults, merged and numbered: none if the log cannot be
/// judged. `model_period_s` is the usual sample period of the logs that the model was learned from, `power`
/// the share of simulated faults that it finds (NaN if not known): a model that finds few faults cannot call
/// a log healthy.
void settle_verdict(Diagnosis& diagnosis, const std::vector<FaultFinding>& faults, double model_period_s,
                    double power = std::numeric_limits<double>::quiet_NaN());

}  // namespace faultline
