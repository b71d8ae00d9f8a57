// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lib/diagnose/diagnosis.hpp"

namespace faultline {

struct TimelineOptions {
  int width = 80;       ///< characters, at least 40
  bool unicode = true;  ///< line-drawing characters, else ASCII
  bool color = false;
};

/// A bar over the run for each joint (and one for the robot when a fault belongs to no joint), a time axis
/// and a legend. The digit is the fault's number at its onset, "!" its alarm; marks that fall on the same
/// place stand side by side. Empty when the log has no span of time.
std::string render_timeline(const Diagnosis& diagnosis, const TimelineOptions& options = {});

/// The report a technician reads in a terminal: verdict, timeline over the run, a block a fault, residuals of
/// the regenerated motion, issues of the log, what cannot be seen.
std::string render_text(const Diagnosis& diagnosis, const TimelineOptions& options = {});

/// The verdict in one sentence, such as "1 fault: joint 2 is locked, from 4.210 s."
std::string verdict_sentence(const Diagnosis& diagnosis);

}  // namespace faultline
