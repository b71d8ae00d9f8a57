// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/identify/identification.hpp"

namespace faultline {

/// For people at a terminal: what was identified, how well it fits, what the motion lacks, what the residual
/// repeats with and what changes from log to log.
std::string identification_text(const Identification& identification);

/// "fc_2 changes from log to log beyond chance: ...", a line each flagged parameter; one line that says so
/// when there is none, and nothing when there were too few logs.
std::vector<std::string> trend_lines(const Identification& identification);

/// What the motion does not show, a line each: what joints lack, parameters that are hardly separable from
/// another.
std::vector<std::string> excitation_lines(const Identification& identification);

/// "96 %"; "-" when it is not known.
std::string share_text(double share);

/// Whether a term pays, or why it is left out all the same.
const char* term_verdict(const ModelTerm& term);

/// A mixture of parameters, such as "I1 - 0.98 mx2"; empty when there is none.
std::string mixture_text(const Excitation& excitation);

}  // namespace faultline
