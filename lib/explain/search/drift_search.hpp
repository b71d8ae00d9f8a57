// SPDX-License-Identifier: MIT
#pragma once

#include "lib/explain/search/white_search.hpp"

namespace faultline {

/// The inertia matrix in each row, kg m^2, kg m or kg.
struct InertiaRows {
  std::vector<Eigen::MatrixXd> column;  ///< by joint: rows x joints
};
InertiaRows inertia_rows(const LogFit& fit);

/// Onsets at which the position of joint `joint` (from 0) may begin to drift: friction with the true
/// velocity, positions that are ever more off, and the jump of the velocity, each for a few rates of drift.
std::vector<Candidate> search_drift(const WhiteSearch& search, const InertiaRows& inertia, int joint);

}  // namespace faultline
