// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/balance/noise.hpp"

namespace faultline {

/// Torques that repeat with a joint's position: the rate of each joint whose sine and cosine, alone and times
/// the torque, explain more than a twentieth of what is left of it. `range` is that of each joint.
std::vector<RippleRate> find_ripples_in_rows(const std::vector<LeftOver>& logs, const RowSetting& setting,
                                             const Eigen::VectorXd& range);

}  // namespace faultline
