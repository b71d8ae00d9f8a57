// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/explain/white_search.hpp"

namespace faultline {

/// Onsets that stand out, for every kind and joint. One pass gives the score of a linear column for every
/// onset from cumulative normal equations.
std::vector<Candidate> search(const LogFit& fit);

}  // namespace faultline
