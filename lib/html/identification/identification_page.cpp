// SPDX-License-Identifier: MIT
#include "lib/html/identification/identification_page.hpp"

#include <fmt/format.h>

#include "lib/core/markup.hpp"
#include "lib/core/text.hpp"
#include "lib/core/version.hpp"
#include "lib/html/elements.hpp"
#include "lib/html/head.hpp"
#include "lib/html/identification/identification_tables.hpp"
#include "lib/html/identification/trend_figures.hpp"
#include "lib/plot/plot_series.hpp"
#include "lib/report/identification_text.hpp"

namespace faultline {
namespace {

/// The class of style.css that colours a verdict.
const char* colour_of(IdentificationStatus status) {
  switch (status) {
    case IdentificationStatus::converged:
      return "healthy";
    case IdentificationStatus::unexplained:
      return "faulty";
    case IdentificationStatus::not_run:
    case IdentificationStatus::not_converged:
    case IdentificationStatus::poorly_excited:
    case IdentificationStatus::poorly_explained:
      return "inconclusive";
  }
  return "inconclusive";
}

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

std::string figures(const std::vector<NamedPlot>& plots) {
  std::string text;
  for (const NamedPlot& plot : plots) text += figure(plot);
  return text.empty() ? "" : "<div class=\"plots\">\n" + text + "</div>\n";
}

std::string top(const Identification& id) {
  std::string status = to_string(id.status);
  for (char& c : status)
    if (c == '_') c = ' ';
  return fmt::format(
      "<header>\n<h1>{}</h1>\n<p class=\"sub\">identified from {} by {}, faultline {}</p>\n"
      "<p class=\"verdict {}\">{}</p>\n<p>{}</p>\n</header>\n",
      escaped_markup(printable(id.robot.name.empty() ? "robot" : id.robot.name)),
      counted(static_cast<long long>(id.logs.size()), "log"), to_string(id.method), program_version(),
      colour_of(id.status), status, escaped_markup(id.reason));
}

std::string part(const char* id, const char* title, const std::string& content) {
  return content.empty() ? "" : fmt::format("<h2 id=\"{}\">{}</h2>\n{}", id, title, content);
}

}  // namespace

std::vector<NamedPlot> identification_figures(const Identification& id) {
  std::vector<NamedPlot> all;
  for (int j = 0; j < std::ssize(id.joint_fits); ++j)
    for (NamedPlot& plot : joint_figures(id, j)) all.push_back(std::move(plot));
  for (NamedPlot& plot : trend_figures(id)) all.push_back(std::move(plot));
  return all;
}

std::string render_identification_html(const Identification& id) {
  std::string text =
      html_head(printable(id.robot.name) + " identified", false) + "<body>\n" + top(id) + "<main>\n";
  text += part("parameters", "Parameters", parameter_tables(id));
  text += part("fit", "Fit", fit_tables(id));
  for (int j = 0; j < std::ssize(id.joint_fits); ++j)
    text += part(fmt::format("joint-{}", j + 1).c_str(), fmt::format("Joint {}", j + 1).c_str(),
                 figures(joint_figures(id, j)));
  text += part("motion", "What the motion tells", excitation_tables(id));
  text += part("trend", "From log to log",
               html_list(trend_lines(id)) + figures(trend_figures(id)) + trend_table(id));
  text += part("logs", "Logs", log_tables(id));
  return text + "</main>\n</body>\n</html>\n";
}

}  // namespace faultline
