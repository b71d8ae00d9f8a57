// SPDX-License-Identifier: MIT
#include "lib/report/html/still_figures.hpp"

#include <fmt/format.h>

#include "lib/core/markup.hpp"
#include "lib/report/plot/plot_series.hpp"

namespace faultline {
namespace {

std::string legend(const LinePlot& plot) {
  std::string text = "<ul class=\"legend\">";
  for (const PlotPanel& panel : plot.panels)
    for (std::size_t i = 0; i < panel.series.size(); ++i) {
      const PlotSeries& series = panel.series[i];
      if (series.name.empty()) continue;
      const PlotPen pen = plot_pen(series.pen < 0 ? i : static_cast<std::size_t>(series.pen));
      text += fmt::format("<li><svg viewBox=\"0 0 28 8\" aria-hidden=\"true\">{}</svg>{}</li>",
                          key_sample(series, pen, 1.0, 4.0), escaped_markup(series.name));
    }
  return text + "</ul>";
}

std::string figure(const NamedPlot& named) {
  LinePlot plot = named.plot;
  plot.id = named.name + "-";
  plot.captions = false;
  return fmt::format("<figure id=\"{}\"><figcaption>{}</figcaption>\n{}\n<div class=\"still\">", named.name,
                     escaped_markup(plot.title), legend(plot)) +
         render_svg(plot) + "</div></figure>\n";
}

}  // namespace

std::string still_figures(const std::vector<NamedPlot>& plots) {
  std::string text;
  for (const NamedPlot& plot : plots) text += figure(plot);
  return text.empty() ? "" : "<div class=\"plots\">\n" + text + "</div>\n";
}

}  // namespace faultline
