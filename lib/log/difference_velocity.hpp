// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "lib/log/log.hpp"

namespace faultline {

/// Whether the velocity of a joint is a backward, forward or central difference of its position, over the
/// stamps or over the usual period, and so no independent measurement. Rows with an unchanged position do not
/// count. False for fewer than 8 rows or for positions without noise.
bool is_difference(std::span<const double> time, std::span<const double> q, std::span<const double> dq);

/// The same for each joint of a log; all false without velocities.
std::vector<char> velocities_by_difference(const Log& log);

}  // namespace faultline
