// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "lib/log/log.hpp"

namespace faultline {

/// Whether the velocity of a joint is a difference of its position, backward, forward or central, over the
/// stamps or over the usual period: it is then no measurement of its own. Rows in which the joint rests do
/// not count. False where there is nothing to tell it from.
bool is_difference(std::span<const double> time, std::span<const double> q, std::span<const double> dq);

/// The same by joint of a log; all false without velocities.
std::vector<char> velocities_by_difference(const Log& log);

}  // namespace faultline
