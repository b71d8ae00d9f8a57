// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/diagnose/diagnosis.hpp"
#include "lib/report/html/page_figures.hpp"

namespace faultline {

/// One fault: times, who decided, what to check next, plots, what else it could be, similar cases, evidence.
std::string html_finding(const FaultFinding& fault, const std::vector<PageFigure>& figures,
                         double sample_period_s);

/// Faults that have a section of their own; later ones stand in the table only.
inline constexpr int kFullFindings = 50;

/// Attributes of a link to a fault: "#fault-ID", or the table when it has no section. The script of the page
/// zooms to its onset, which counts from `zero_s`.
std::string html_fault_link(const FaultFinding& fault, double zero_s);

/// All faults, a row each.
std::string html_fault_table(const Diagnosis& diagnosis);

/// A grid of figures with the place for their buttons.
std::string html_plots(const std::vector<PageFigure>& figures, int fault_id, double sample_period_s);

/// The run from left to right, a lane a joint, as an SVG whose text keeps its size; each fault is a link to
/// "#fault-ID" that names its kind and times. Empty when the log has no span of time.
std::string html_timeline(const Diagnosis& diagnosis);

}  // namespace faultline
