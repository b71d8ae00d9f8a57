// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/explain/search/white_search.hpp"

namespace faultline {

/// Returns the onsets that stand out, for every kind and joint. One pass scores a linear column at every
/// onset by cumulative normal equations.
std::vector<Candidate> search(const LogFit& fit);

/// Returns onsets at which the position of a joint may begin to drift, for some rates and each joint: by the
/// friction at the true velocity, the growing error of the position and the jump of the velocity.
std::vector<Candidate> search_drifts(const WhiteSearch& search);

}  // namespace faultline
