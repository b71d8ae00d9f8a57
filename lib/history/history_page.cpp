// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "lib/core/text.hpp"
#include "lib/core/version.hpp"
#include "lib/history/robot_history.hpp"
#include "lib/report/html/elements.hpp"

namespace faultline {
namespace {

constexpr std::size_t kColumns = 8;        // of the table of robots
constexpr std::size_t kLongestText = 200;  // bytes of a name on the page

std::string safe(const std::string& text) { return escaped_markup(printable(text).substr(0, kLongestText)); }

std::string labelled(const char* label, const std::string& html) {
  return fmt::format("<td data-label=\"{}\">{}</td>", label, html);
}

std::string last_change(const RobotHistory& robot) {
  const ConditionSeries* latest = nullptr;
  const SeriesChange* change = nullptr;
  for (const ConditionSeries& series : robot.wear.series) {
    if (series.trend.changes.empty()) continue;
    const SeriesChange& last = series.trend.changes.back();
    const auto log_of = [](const ConditionSeries& s, const SeriesChange& c) {
      return s.logs[static_cast<std::size_t>(c.first)];
    };
    if (latest && log_of(series, last) <= log_of(*latest, *change)) continue;
    latest = &series;
    change = &last;
  }
  if (latest)
    return escaped_markup(printable(latest->what + " " + change_words(robot.wear, *latest, *change)));
  const ConditionSeries* leading = leading_series(robot.wear);
  return leading ? escaped_markup(no_change_words(*leading)) : "not applicable";
}

/// The trend that is least likely by chance, if one is beyond it, else that of the leading item.
std::string trend_cell(const RobotHistory& robot, const ConditionSeries* leading) {
  const ConditionSeries* surest = nullptr;
  for (const ConditionSeries& series : robot.wear.series)
    if (series.trend.is_trend && (!surest || series.trend.p < surest->trend.p)) surest = &series;
  if (surest && surest != leading)
    return escaped_markup(printable(surest->what + " " + trend_words(robot.wear, *surest)));
  return leading ? escaped_markup(trend_words(robot.wear, *leading)) : "not applicable";
}

std::string robot_row(const RobotHistory& robot, std::size_t number) {
  const ConditionSeries* leading = leading_series(robot.wear);
  const std::string date = date_text(robot.last_start_s);
  return "<tr>" + labelled("robot", fmt::format("<a href=\"#robot-{}\">{}</a>", number, safe(robot.robot))) +
         labelled("logs", std::to_string(robot.logs)) +
         labelled("last log", date.empty() ? safe(robot.last_log) : date) +
         labelled("worst finding", escaped_markup(worst_words(robot))) +
         labelled("condition", leading ? safe(leading->what) : "not applicable") +
         labelled("course", leading ? course_picture(*leading) : "") +
         labelled("trend", trend_cell(robot, leading)) + labelled("latest change", last_change(robot)) +
         "</tr>\n";
}

std::string robots_table(const std::vector<RobotHistory>& robots) {
  std::string text = fmt::format("<div class=\"wide\"><table{}>\n<thead><tr>", html_table_class(kColumns));
  for (const char* head :
       {"robot", "logs", "last log", "worst finding", "condition", "course", "trend", "latest change"})
    text += fmt::format("<th scope=\"col\">{}</th>", head);
  text += "</tr></thead>\n<tbody>\n";
  for (std::size_t i = 0; i < robots.size(); ++i) text += robot_row(robots[i], i + 1);
  return text + "</tbody></table></div>\n";
}

std::string robot_section(const RobotHistory& robot, std::size_t number) {
  std::string text = fmt::format(
      "<h2 id=\"robot-{}\">{}</h2>\n<p>{}: {} healthy, {} faulty, {} inconclusive; model <span "
      "class=\"hash\">{}</span>.</p>\n",
      number, safe(robot.robot), counted(robot.logs, "log"), robot.healthy, robot.faulty, robot.inconclusive,
      escaped_markup(robot.wear.model_sha256.substr(0, 12)));
  if (robot.of_other_models > 0)
    text += fmt::format(
        "<p>{} with earlier models of this robot are not shown: each model counts from its own zero. Diagnose "
        "those logs with the current model to see them here.</p>\n",
        counted(robot.of_other_models, "result"));
  if (!robot.wear.by_date && robot.wear.not_applicable.empty())
    text +=
        "<p>In the order in which the results were added: trends by date are not applicable, since not every "
        "log contains a date.</p>\n";
  return text + wear_table(robot.wear);
}

}  // namespace

std::string history_page(const std::vector<RobotHistory>& robots) {
  const std::string title = "History of " + counted(static_cast<long long>(robots.size()), "robot");
  std::string text = html_head(title, false) + "<body>\n<main>\n<header>\n<h1>" + title + "</h1>\n";
  text += fmt::format(
      "<p class=\"sub\">faultline {}</p>\n</header>\n<p>Condition from log to log against the model, with 95 % "
      "intervals. Of each robot the first table shows the item that is least likely by chance. Beyond chance: "
      "of robots that do not change, one in 100 shows such a change.</p>\n",
      escaped_markup(program_version()));
  if (robots.empty()) text += "<p>The history contains no result.</p>\n";
  if (!robots.empty()) text += robots_table(robots);
  for (std::size_t i = 0; i < robots.size(); ++i) text += robot_section(robots[i], i + 1);
  return text + "</main>\n</body>\n</html>\n";
}

}  // namespace faultline
