// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/diagnose/curves/curves.hpp"
#include "lib/diagnose/diagnosis.hpp"
#include "lib/report/html/page_figures.hpp"

namespace faultline {

/// What the script of the page draws from, as JSON that is safe inside a <script> element: {"windows":
/// [{from, to, fault, keys: {KEY: [low, high, DATA]}}], "traces": [{times, keys: {KEY: [...]}}], "figures":
/// [...]}. DATA is base64 of little-endian 16-bit numbers from 0 (low) to 65534 (high); 65535 is missing.
std::string html_plot_data(const std::vector<FaultFinding>& faults, const RunCurves& curves,
                           const std::vector<PageFigure>& figures);

}  // namespace faultline
