// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/diagnosis/diagnosis.hpp"
#include "lib/report/html_figures.hpp"

namespace faultline {

/// One fault: times, who decided, what to check next, plots, what else it could be, similar cases, evidence.
std::string html_finding(const FaultFinding& fault, const std::vector<PageFigure>& figures,
                         double sample_period_s);

/// All faults, a row each.
std::string html_fault_table(const Diagnosis& diagnosis);

/// A grid of figures with the place for their buttons.
std::string html_plots(const std::vector<PageFigure>& figures, int fault_id, double sample_period_s);

}  // namespace faultline
