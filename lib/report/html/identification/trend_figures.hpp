// SPDX-License-Identifier: MIT
#pragma once

#include "lib/report/html/identification/joint_figures.hpp"

namespace faultline {

/// The value of each flagged parameter in each log with its 95 % interval, and the mean of all.
std::vector<NamedPlot> trend_figures(const Identification& identification);

}  // namespace faultline
