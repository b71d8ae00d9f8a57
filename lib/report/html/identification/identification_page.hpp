// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/identify/identification.hpp"
#include "lib/report/html/elements.hpp"

namespace faultline {

/// One self-contained page without scripts: status, parameters, fit, what each joint's torque leaves and what
/// it repeats with, excitation and trends. The same identification gives the same bytes.
std::string render_identification_html(const Identification& identification);

/// The size of every figure.
LinePlot figure_plot(const std::string& title, const std::string& x_label);

/// One joint (from 0): measured and modelled torque over the log that is explained worst and over the seconds
/// of it where most is left, what is left over position and speed, friction over speed, and the spectrum of
/// what is left. Empty without curves, as after reading an identification from JSON.
std::vector<NamedPlot> joint_figures(const Identification& identification, int j);

/// The pictures of a page, to be drawn one by one with render_svg.
std::vector<NamedPlot> identification_figures(const Identification& identification);

}  // namespace faultline
