// SPDX-License-Identifier: MIT
#pragma once

#include "lib/golden/comparison.hpp"

namespace faultline {

/// Compares what was predicted at the same times, channel by channel: of each that differs, the first time
/// and both values. The first time that only one trace has is a difference unless the length may differ.
void compare_traces(const Trace& expected, const Trace& actual, const ToleranceChain& tolerances,
                    Comparison& comparison);

}  // namespace faultline
