// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "lib/explain/log_fit.hpp"

namespace faultline {

/// What a joint at rest yields to.
struct Yielding {
  double compliance = 0.0;  ///< rad per N m or m per N
  Eigen::VectorXd load;     ///< by row, N m or N
  double doubt = 0.0;       ///< share of the deflection by which the position may differ from it
};

/// Returns how joint `j` (from 0) yields in these rows if it is locked: its brake or jammed gear to the part
/// of the torque that does not move the arm, or at least its gear as the model says. The latter if the
/// position follows the torque further than any lock allows, or against it.
Yielding yielding_of_lock(const LogFit& fit, int j, const std::vector<int>& rows);
/// Returns how the gear of joint `j` (from 0) yields to its torque.
Yielding yielding_of_gear(const LogFit& fit, int j);

/// Returns since which row joint `j` (from 0) has stood still at the end of the log, but for the spring of
/// its gear and of a lock that yields to the torque.
int still_since(const LogFit& fit, int j);

/// Returns when a joint (from 0) that is locked from `from_s` on moves again, with its spring or without,
/// since the lock may be on either side of it. Empty if it never does.
std::optional<double> moves_from(const LogFit& fit, int j, double from_s);

}  // namespace faultline
