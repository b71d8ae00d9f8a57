// SPDX-License-Identifier: MIT
#pragma once

#include "lib/report/html/identification/joint_figures.hpp"

namespace faultline {

/// Measured and modelled torque, and what is left, of the log that is explained worst: all of it, and the
/// seconds where most is left.
std::vector<NamedPlot> torque_figures(const Identification& identification, int joint);

/// The size of every figure.
LinePlot figure_plot(const std::string& title, const std::string& x_label);

}  // namespace faultline
