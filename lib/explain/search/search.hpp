// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/explain/search/white_search.hpp"

namespace faultline {

/// Onsets that stand out, for every kind and joint. One pass gives the score of a linear column for every
/// onset from cumulative normal equations.
std::vector<Candidate> search(const LogFit& fit);

/// Where a joint is, but for its spring, and how far it seems to move while it stands.
struct Standstill {
  Eigen::VectorXd place;  ///< by row, rad or m
  double tolerance = 0.0;
};

/// That of joint `joint` (from 0).
Standstill standstill(const LogFit& fit, int joint);

}  // namespace faultline
