// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/identify/identification.hpp"
#include "lib/report/plot/line_plot.hpp"

namespace faultline {

/// A picture of the identification page.
struct NamedPlot {
  std::string name;  ///< of its own on the page, fit to be a file's
  LinePlot plot;
};

/// One joint (from 0): measured and modelled torque over the log that is explained worst and over the seconds
/// of it where most is left, what is left over position and speed, friction over speed, and the spectrum of
/// what is left. Empty without curves, as after reading an identification from JSON.
std::vector<NamedPlot> joint_figures(const Identification& identification, int joint);

}  // namespace faultline
