// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/report/html/identification/joint_figures.hpp"

namespace faultline {

/// Pictures with caption and legend, for a page without scripts; empty without plots.
std::string still_figures(const std::vector<NamedPlot>& plots);

}  // namespace faultline
