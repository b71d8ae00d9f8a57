// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/diagnose/diagnosis.hpp"
#include "lib/diagnose/stop/stop_answer.hpp"

namespace faultline {

/// Returns the answer in sentences: what was found before the stop, the first sign, the joint that leads,
/// what changed, what was normal, and how small a change would have been seen.
std::vector<std::string> stop_summary(const StopAnswer& stop, const Diagnosis& diagnosis);

/// Returns what was not looked at, a sentence each.
std::vector<std::string> stop_not_looked(const StopAnswer& stop, const Diagnosis& diagnosis);

}  // namespace faultline
