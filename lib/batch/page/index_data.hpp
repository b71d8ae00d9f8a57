// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/batch/batch_summary.hpp"

namespace faultline {

/// All rows as JSON for the page's scripts, safe inside a <script> element: {pages, time, models[], labels[],
/// parameters[], rows[]}; a row is [log, verdict, model, result, faults, reason, start_s, end_s, period_s,
/// joints, issues, rows, residual_rms[], residual_peak[], condition, parameters], a fault [label, joint,
/// onset_s, alarm_s, end_s, confidence], a condition or parameter [name, value, half of its 95 % interval];
/// models, labels and names by their place in the lists. `time`: all judged logs tell the date.
std::string index_data(const std::vector<BatchRow>& rows, const BatchFacts& facts, bool pages);

}  // namespace faultline
