// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/golden/comparison.hpp"

namespace faultline {

/// Pairs events of the same kind and joint, the nearest onsets first, and compares their times and
/// confidence; what has no partner is missing or unexpected.
Comparison compare_events(const std::vector<ObservedEvent>& expected,
                          const std::vector<ObservedEvent>& actual, const ToleranceChain& tolerances);

}  // namespace faultline
