// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/identify/identification.hpp"
#include "lib/identify/torque_fit.hpp"

namespace faultline {

/// What each log alone says of every parameter that was fitted, by the same windows and terms, and whether it
/// changes from log to log. A log counts for a parameter only when its own motion tells it; a parameter that
/// fewer than three logs tell is left out. Empty with fewer logs. Needs `id.joint_fits`.
///
/// A variance is the larger of two: from blocks of one log's residual (sandwich), which feel model error
/// where it falls, and from the residual's autocorrelation over all logs together, which a short log cannot
/// tell.
std::vector<ParameterTrend> parameter_trends(const TorqueFit& torque, const Identification& id);

}  // namespace faultline
