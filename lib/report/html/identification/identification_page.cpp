// SPDX-License-Identifier: MIT
#include "lib/report/html/identification/identification_page.hpp"

#include <fmt/format.h>

#include <cmath>

#include "lib/core/number_text.hpp"
#include "lib/core/text.hpp"
#include "lib/core/version.hpp"
#include "lib/report/html/elements.hpp"
#include "lib/report/identification_text.hpp"
#include "lib/robot/chain.hpp"

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

std::string r2_text(double r2) { return std::isfinite(r2) ? fmt::format("{:.4f}", r2) : "-"; }

double nth(const std::vector<double>& values, std::size_t i) {
  return i < values.size() ? values[i] : std::nan("");
}

std::string chance_text(double p) { return p < 1e-4 ? "< 0.0001" : fmt::format("{:.4f}", p); }

std::string parameter_table(const char* title, const std::vector<ParameterEstimate>& list) {
  std::vector<HtmlRow> rows;
  for (const ParameterEstimate& e : list) {
    if (!e.identifiable) {
      rows.push_back({e.name, "-", "", e.unit, "not identifiable: " + e.why_not});
      continue;
    }
    const std::string interval =
        e.std > 0.0 ? fmt::format("{} to {}", fact_text(e.ci95[0]), fact_text(e.ci95[1])) : "given";
    rows.push_back({e.name, fact_text(e.value), interval, e.unit, e.meaning == e.name ? "" : e.meaning});
  }
  return html_table(FactTable{title, {"parameter", "value", "95 % interval", "unit", "meaning"}, rows});
}

std::string term_table(const Identification& id) {
  std::vector<HtmlRow> rows;
  for (const ModelTerm& t : id.terms)
    rows.push_back({t.name, fmt::format("{}", t.joint), fact_text(t.error_before), fact_text(t.error_after),
                    std::string("it ") + term_verdict(t)});
  return html_table(FactTable{"Candidate terms, and the held-out torque residual without and with them",
                              {"term", "joint", "without it", "with it", "outcome"},
                              rows});
}

std::string pattern_table(const Identification& id) {
  std::vector<HtmlRow> rows;
  for (int j = 0; j < std::ssize(id.residual_patterns); ++j) {
    const ResidualPattern& p = id.residual_patterns[j];
    rows.push_back({fmt::format("{}", Joint::at(j)), share_text(p.position), share_text(p.speed),
                    share_text(p.torque), share_text(p.previous)});
  }
  return html_table(FactTable{"Patterns of the torque residual, in shares of its variance",
                              {"joint", "position", "speed", "torque", "its value a window before"},
                              rows});
}

std::string parameter_tables(const Identification& id) {
  return parameter_table("Base parameters and friction", id.base_parameters) +
         parameter_table("Masses and lengths", id.physical_parameters);
}

std::string fit_tables(const Identification& id) {
  std::vector<HtmlRow> rows;
  for (int j = 0; j < std::ssize(id.fit_r2); ++j) {
    const AxisKind kind = id.space.chain.geometry[j].kind;
    rows.push_back(
        {fmt::format("{}", Joint::at(j)), r2_text(id.fit_r2[j]), r2_text(nth(id.held_out_r2, j)),
         fact_text(nth(id.residual_rms, j), torque_unit(kind)),
         fmt::format("{:.2g} ms", 1e3 * nth(id.torque_delay_s, j)),
         fmt::format("{:.3g} {}", nth(id.q_noise, j), position_unit(kind)),
         id.dq_noise.empty() ? "-" : fmt::format("{:.3g} {}", nth(id.dq_noise, j), velocity_unit(kind))});
  }
  return html_table({"joint", "R2", "R2 held out", "residual, rms", "torque is late by", "noise of q",
                     "noise of dq"},
                    rows, "Fit of each joint") +
         term_table(id) + pattern_table(id);
}

std::string excitation_tables(const Identification& id) {
  std::vector<HtmlRow> joints, parameters;
  for (int j = 0; j < std::ssize(id.excitation.joints); ++j) {
    const JointExcitation& e = id.excitation.joints[j];
    const AxisKind kind = id.space.chain.geometry[j].kind;
    joints.push_back({fmt::format("{}", Joint::at(j)),
                      fmt::format("{:.3g} to {:.3g} {}", e.q_low, e.q_high, position_unit(kind)),
                      fmt::format("{:.3g} {}", e.fastest_forward, velocity_unit(kind)),
                      fmt::format("{:.3g} {}", e.fastest_back, velocity_unit(kind)), share_text(e.forward),
                      e.lacks.empty() ? "nothing" : e.lacks});
  }
  for (const ParameterExcitation& p : id.excitation.parameters)
    parameters.push_back(
        {p.name, std::isfinite(p.own) ? fmt::format("{:.2g}", p.own) : "not shown", p.mixed_with});
  const std::string mixture = mixture_text(id.excitation);
  return html_list(excitation_lines(id)) +
         html_table({"joint", "position", "fastest forward", "fastest back", "time forward", "lacks"}, joints,
                    "Motion of each joint") +
         html_table(FactTable{
             "Share of each parameter's effect on the torque that no combination of the others reproduces (1: all)",
             {"parameter", "its own", "hardest to separate from"},
             parameters}) +
         (mixture.empty()
              ? ""
              : html_part("The combination of parameters that is determined least", html_list({mixture})));
}

std::string trend_table(const Identification& id) {
  std::vector<HtmlRow> rows;
  HtmlRow head = {"parameter"};
  for (std::size_t i = 0; i < id.logs.size(); ++i) head.push_back(fmt::format("log {}", i + 1));
  for (const char* name : {"unit", "p-value if equal", "a log", "p-value if no trend", "remark"})
    head.emplace_back(name);
  for (const ParameterTrend& t : id.trends) {
    HtmlRow row(id.logs.size() + 1, "-");
    row[0] = t.name;
    for (const LogValue& v : t.by_log)
      row[static_cast<std::size_t>(v.log) + 1] =
          fmt::format("{} ± {:.2g}", fact_text(v.value), v.ci95[1] - v.value);
    row.insert(row.end(),
               {t.unit, chance_text(t.p_same), fmt::format("{:+.3g}", t.slope), chance_text(t.p_level),
                t.drifts    ? "drifts"
                : t.differs ? "differs"
                            : ""});
    rows.push_back(std::move(row));
  }
  return html_table(head, rows, "From log to log");
}

std::string log_tables(const Identification& id) {
  std::vector<HtmlRow> rows, issues;
  for (std::size_t i = 0; i < id.logs.size(); ++i) {
    const IdentifiedLog& log = id.logs[i];
    std::string r2;
    for (const double value : log.fit_r2) r2 += (r2.empty() ? "" : ", ") + r2_text(value);
    rows.push_back({std::to_string(i + 1), printable(log.path), std::to_string(log.rows),
                    std::to_string(log.rows_used), value_text(log.sample_period_s) + " s",
                    r2.empty() ? "-" : r2, log.left_out ? "left out" : "", log.sha256});
  }
  for (const Issue& issue : id.issues.all())
    issues.push_back({to_string(issue.severity), issue.code, std::to_string(issue.count), issue.message});
  return html_table({"log", "path", "rows", "used", "period", "R2 by joint", "remark", "SHA-256"}, rows,
                    "Logs") +
         html_table(FactTable{"Issues", {"severity", "code", "times", "what"}, issues});
}

NamedPlot trend_figure(const ParameterTrend& trend, std::size_t logs) {
  const double first = 0.5, last = static_cast<double>(logs) + 0.5;
  PlotSeries values{.name = "each log alone", .x = {}, .y = {}, .points = true};
  for (const LogValue& v : trend.by_log) {
    values.x.push_back(v.log + 1.0);
    values.y.push_back(v.value);
    values.bar.push_back(0.5 * (v.ci95[1] - v.ci95[0]));
  }
  LinePlot plot = figure_plot(fmt::format("{} from log to log", trend.name), "log");
  plot.panels = {{.y_label = trend.unit.empty() ? trend.name : fmt::format("{}, {}", trend.name, trend.unit),
                  .series = {values, {.name = "mean", .x = {first, last}, .y = {trend.mean, trend.mean}}}}};
  return {"trend-" + trend.name, plot};
}

/// The value of each flagged parameter in each log with its 95 % interval, and the mean of all.
std::vector<NamedPlot> trend_figures(const Identification& id) {
  std::vector<NamedPlot> plots;
  for (const ParameterTrend& trend : id.trends)
    if (trend.flagged()) plots.push_back(trend_figure(trend, id.logs.size()));
  return plots;
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
    text += part(fmt::format("joint-{}", Joint::at(j)).c_str(), fmt::format("Joint {}", Joint::at(j)).c_str(),
                 still_figures(joint_figures(id, j)));
  text += part("motion", "Excitation: how well the motion determines the parameters", excitation_tables(id));
  text += part("trend", "From log to log",
               html_list(trend_lines(id)) + still_figures(trend_figures(id)) + trend_table(id));
  text += part("logs", "Logs", log_tables(id));
  return text + "</main>\n</body>\n</html>\n";
}

}  // namespace faultline
