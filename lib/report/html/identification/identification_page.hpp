// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/identify/identification.hpp"
#include "lib/report/html/identification/joint_figures.hpp"

namespace faultline {

/// One self-contained page without scripts: status, parameters, fit, what each joint's torque leaves and what
/// it repeats with, excitation and trends. The same identification gives the same bytes.
std::string render_identification_html(const Identification& identification);

/// Its pictures, to be drawn one by one with render_svg.
std::vector<NamedPlot> identification_figures(const Identification& identification);

}  // namespace faultline
