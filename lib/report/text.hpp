// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lib/diagnose/diagnosis.hpp"
#include "lib/report/timeline.hpp"

namespace faultline {

/// The report a technician reads in a terminal: verdict, timeline over the run, a block a fault, residuals of
/// the regenerated motion, issues of the log, what cannot be seen.
std::string render_text(const Diagnosis& diagnosis, const TimelineOptions& options = {});

/// The verdict in one sentence, such as "1 fault: joint 2 is locked, from 4.210 s."
std::string verdict_sentence(const Diagnosis& diagnosis);

}  // namespace faultline
