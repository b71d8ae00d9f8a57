// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/identify/identification.hpp"
#include "lib/identify/torque_fit.hpp"

namespace faultline {

/// Returns the estimates from each log alone of every fitted parameter, with the same windows and terms, and
/// whether they change from log to log. A log counts for a parameter only if its own motion determines it; a
/// parameter with fewer than three such logs is omitted. Empty with fewer logs. Needs `id.joint_fits`.
///
/// A variance is the larger of two: from blocks of one log's residual (jackknife), which show model error
/// where it occurs, and from the residual's autocorrelation over all logs together, which a short log cannot
/// determine.
std::vector<ParameterTrend> parameter_trends(const TorqueFit& torque, const Identification& id);

}  // namespace faultline
