// SPDX-License-Identifier: MIT
#include "lib/report/html/identification/identification_page.hpp"

#include <fmt/format.h>

#include "lib/core/markup.hpp"
#include "lib/core/text.hpp"
#include "lib/core/version.hpp"
#include "lib/report/html/elements.hpp"
#include "lib/report/html/head.hpp"
#include "lib/report/html/identification/identification_tables.hpp"
#include "lib/report/html/identification/trend_figures.hpp"
#include "lib/report/html/still_figures.hpp"
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
                 still_figures(joint_figures(id, j)));
  text += part("motion", "Excitation: how well the motion determines the parameters", excitation_tables(id));
  text += part("trend", "From log to log",
               html_list(trend_lines(id)) + still_figures(trend_figures(id)) + trend_table(id));
  text += part("logs", "Logs", log_tables(id));
  return text + "</main>\n</body>\n</html>\n";
}

}  // namespace faultline
