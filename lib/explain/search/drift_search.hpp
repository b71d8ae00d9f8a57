// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/explain/search/white_search.hpp"

namespace faultline {

/// Returns onsets at which the position of a joint may begin to drift, for some rates and each joint: by the
/// friction at the true velocity, the growing error of the position and the jump of the velocity.
std::vector<Candidate> search_drifts(const WhiteSearch& search);

}  // namespace faultline
