// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "lib/diagnose/curves/curves.hpp"
#include "lib/diagnose/diagnosis.hpp"
#include "lib/report/plot/line_plot.hpp"

namespace faultline {

/// One line of a figure. Its samples lie in equal distances over a window, or at `times` when there are any.
struct FigureCurve {
  std::string name;
  std::string key;  ///< of the same signal in every window, such as "q1"
  int pen = 0;      ///< plot_pen(); curves are drawn in their order, later ones on top
  const CurveWindow* window = nullptr;
  const std::vector<float>* values = nullptr;
  const std::vector<double>* times = nullptr;
  const std::vector<double>* ratios = nullptr;  ///< at `times`

  std::size_t count() const { return times ? times->size() : values->size(); }
  double time_s(std::size_t i) const { return times ? (*times)[i] : window->time_s(i, values->size()); }
  double value(std::size_t i) const { return ratios ? (*ratios)[i] : (*values)[i]; }
};

/// A constant that the curves are to be compared with.
struct FigureLimit {
  std::string name;
  double value = 0.0;
};

/// One plot of the page.
struct PageFigure {
  std::string id;
  int fault_id = 0;  ///< 0: of the whole run
  int group = 0;     ///< figures of one group share zoom and cursor
  std::string caption;
  std::string y_label;  ///< with its unit
  bool log_y = false;
  std::vector<FigureCurve> curves;
  std::vector<FigureLimit> limits;
  std::vector<PlotMark> marks;
  double from_s = 0.0, to_s = 0.0;  ///< shown at first
  /// What lies below is of no interest and would squeeze the rest.
  double least_y = -std::numeric_limits<double>::infinity();
};

/// The plots of the whole run: residuals, then position, velocity and torque of each joint. They refer to
/// `curves`, which must outlive them. `more`: marks beside those of the faults, such as that of a stop.
std::vector<PageFigure> run_figures(const std::vector<FaultFinding>& faults, const RunCurves& curves,
                                    const std::vector<PlotMark>& more = {});

/// The plots around one fault; none when `curves` has no detail of it. `more`: as above.
std::vector<PageFigure> fault_figures(const FaultFinding& fault, const RunCurves& curves,
                                      const std::vector<PlotMark>& more = {});

/// A figure as it is without script and on paper: caption, legend, a picture and, to unfold, a table. The
/// script of the page puts a plot into its element of class "live".
std::string html_figure(const PageFigure& figure, double sample_period_s);

/// What the script of the page draws from, as JSON that is safe inside a <script> element: {"windows":
/// [{from, to, fault, keys: {KEY: [low, high, DATA]}}], "traces": [{times, keys: {KEY: [...]}}], "figures":
/// [...]}. DATA is base64 of little-endian 16-bit numbers from 0 (low) to 65534 (high); 65535 is missing.
std::string html_plot_data(const std::vector<FaultFinding>& faults, const RunCurves& curves,
                           const std::vector<PageFigure>& figures);

/// One fault: times, who decided, what to check next, plots, what else it could be, similar cases, evidence.
std::string html_finding(const FaultFinding& fault, const std::vector<PageFigure>& figures,
                         double sample_period_s);

/// Faults that have a section of their own; later ones stand in the table only.
inline constexpr int kFullFindings = 50;

/// Attributes of a link to a fault: "#fault-ID", or the table when it has no section. The script of the page
/// zooms to its onset, which counts from `zero_s`.
std::string html_fault_link(const FaultFinding& fault, double zero_s);

std::string html_fault_table(const Diagnosis& diagnosis);

/// A grid of figures with the place for their buttons.
std::string html_plots(const std::vector<PageFigure>& figures, int fault_id, double sample_period_s);

/// The run from left to right, a lane a joint, as an SVG whose text keeps its size; each fault is a link to
/// "#fault-ID" that names its kind and times. Empty when the log has no span of time.
std::string html_timeline(const Diagnosis& diagnosis);

}  // namespace faultline
