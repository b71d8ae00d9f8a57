// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/explain/white_search.hpp"

namespace faultline {

/// Columns of the faults that stay and are linear: torque loss and friction of each joint, payload at the
/// tip.
struct LinearFault {
  FaultKind kind = FaultKind::none;
  int joint = 0;  ///< from 1
  FaultColumns columns;
  std::vector<Eigen::VectorXd> starts;  ///< sizes to search the path of a work piece from
};

std::vector<LinearFault> linear_faults(const LogFit& fit);

/// Onsets that stand out, for every kind and joint. One pass gives the score of a linear column for every
/// onset from cumulative normal equations.
std::vector<Candidate> search(const LogFit& fit, const std::vector<LinearFault>& linear);

/// Mass that the last joint carries, kg, as its torque shows it.
double carried_mass(const LogFit& fit);

}  // namespace faultline
