// SPDX-License-Identifier: MIT
#pragma once

#include "lib/explain/search/white_search.hpp"

namespace faultline {

/// Onsets at which the position of joint `joint` (from 0) may begin to drift: friction with the true
/// velocity, positions that are ever more off, and the jump of the velocity, each for a few rates of drift.
std::vector<Candidate> search_drift(const WhiteSearch& search, int joint);

}  // namespace faultline
