// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lib/report/html/page_figures.hpp"

namespace faultline {

/// A figure as it is without script and on paper: caption, legend, a picture and, to unfold, a table. The
/// script of the page puts a plot into its element of class "live".
std::string html_figure(const PageFigure& figure, double sample_period_s);

}  // namespace faultline
