// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>

#include "apps/service/pages/pages.hpp"
#include "lib/core/text.hpp"

namespace faultline {
namespace {

std::string run_choice(const char* id, const char* label, const std::vector<Job>& runs) {
  std::string text = fmt::format(
      "<div><label for=\"{0}\">{1}</label>\n<select id=\"{0}\" name=\"{0}\" required>\n", id, label);
  for (const Job& run : runs)
    text += fmt::format("<option value=\"{}\">{}: {}</option>\n", run.id, run.id,
                        safe_text(shortened(title_of(run), kLongestName)));
  return text + "</select></div>\n";
}

std::string compare_form(const PageContext& context, const ServedRobot& robot) {
  std::vector<Job> runs;
  for (const Job& run : robot.runs)
    if (run.outcome.state == JobState::done && run.request.files == RunFiles::single) runs.push_back(run);
  if (runs.size() < 2) return "";
  std::vector<Job> rest(runs.begin() + 1, runs.end());
  rest.push_back(runs[0]);  // so that two runs are chosen first
  return "<h2>Compare two runs</h2>\n<form class=\"case\" method=\"post\" action=\"/jobs\">\n" +
         hidden_field("key", context.form_key) + hidden_field("kind", "compare") +
         hidden_field("model", robot.model) + "<div class=\"row\">" + run_choice("first", "First", rest) +
         run_choice("second", "Second", runs) + "</div>\n<p><button>Compare</button></p>\n</form>\n";
}

std::string page_links(const ServedRobot& robot, std::size_t page, std::size_t pages) {
  if (pages < 2) return "";
  std::string text = "<p>";
  if (page > 1)
    text += fmt::format("<a href=\"{}?page={}\">Later runs</a> ", robot_address(robot.model), page - 1);
  text += fmt::format("Page {} of {}", page, pages);
  if (page < pages)
    text += fmt::format(" <a href=\"{}?page={}\">Earlier runs</a>", robot_address(robot.model), page + 1);
  return text + "</p>\n";
}

}  // namespace

std::string robot_page(const PageContext& context, const ServedRobot& robot, const std::string& condition,
                       std::size_t page) {
  const std::size_t pages = std::max<std::size_t>(1, (robot.runs.size() + kRunsPerPage - 1) / kRunsPerPage);
  page = std::clamp<std::size_t>(page, 1, pages);
  const auto begin = robot.runs.begin() + static_cast<std::ptrdiff_t>((page - 1) * kRunsPerPage);
  const auto count = std::min<std::ptrdiff_t>(kRunsPerPage, robot.runs.end() - begin);
  std::string text = fmt::format("<h1>{}</h1>\n", safe_text(robot.model)) + drop_form(context, {robot.model});
  text += "<h2>Runs</h2>\n";
  text += robot.runs.empty() ? "<p>No log of this robot was diagnosed yet.</p>\n"
                             : job_table({begin, begin + count}, false) + page_links(robot, page, pages);
  if (!condition.empty()) text += "<h2>Condition over time</h2>\n" + condition;
  return service_page(context, robot.model, text + compare_form(context, robot));
}

}  // namespace faultline
