// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "apps/service/pages/pages.hpp"
#include "lib/cases/case_file.hpp"
#include "lib/core/text.hpp"
#include "lib/report/html/elements.hpp"

namespace faultline {
namespace {

std::string cell(const char* label, const std::string& html) {
  return fmt::format("<td data-label=\"{}\">{}</td>", label, html);
}

std::string table_head(const std::vector<const char*>& heads, const char* caption) {
  std::string text = fmt::format(
      "<div class=\"wide\"><table{}>\n<caption><span class=\"unseen\">{}</span></caption>\n<thead><tr>",
      html_table_class(heads.size()), caption);
  for (const char* head : heads) text += fmt::format("<th scope=\"col\">{}</th>", head);
  return text + "</tr></thead>\n<tbody>\n";
}

constexpr const char* kTableEnd = "</tbody></table></div>\n";

/// How a job stands, in one or two words.
std::string state_words(const Job& job) {
  if (job.outcome.state == JobState::done && !job.outcome.verdict.empty()) return job.outcome.verdict;
  return to_string(job.state());
}

std::string result_html(const Job& job) {
  const std::string words = state_words(job);
  return fmt::format("<span class=\"{}\">{}</span>", words, words) +
         (job.outcome.sentence.empty() ? ""
                                       : ": " + safe_text(shortened(job.outcome.sentence, kLongestName * 3)));
}

std::string robot_link(const std::string& model) {
  return fmt::format("<a href=\"{}\">{}</a>", robot_address(model), safe_text(model));
}

std::string robots_table(const std::vector<ServedRobot>& robots) {
  std::string text = table_head({"robot", "runs", "last run", "result"}, "Robots");
  for (const ServedRobot& robot : robots) {
    text += "<tr>" + cell("robot", robot_link(robot.model)) + cell("runs", std::to_string(robot.runs.size()));
    if (robot.runs.empty())
      text += cell("last run", "none") + cell("result", "");
    else
      text += cell("last run", moment_text(robot.runs[0].request.received_s)) +
              cell("result", result_html(robot.runs[0]));
    text += "</tr>\n";
  }
  return text + kTableEnd;
}

}  // namespace

std::string job_table(const std::vector<Job>& jobs, bool with_robot) {
  std::vector<const char*> heads{"log", "robot", "received", "result"};
  if (!with_robot) heads.erase(heads.begin() + 1);
  std::string text = table_head(heads, "Runs");
  for (const Job& job : jobs) {
    text += "<tr>" + cell("log", fmt::format("<a href=\"{}\">{}</a>", job_address(job.id),
                                             safe_text(shortened(title_of(job), kLongestName))));
    if (with_robot) text += cell("robot", safe_text(job.request.model));
    text +=
        cell("received", moment_text(job.request.received_s)) + cell("result", result_html(job)) + "</tr>\n";
  }
  return text + kTableEnd;
}

std::string drop_form(const PageContext& context, const std::vector<std::string>& models) {
  std::string text =
      "<form class=\"drop\" method=\"post\" action=\"/jobs\" enctype=\"multipart/form-data\">\n" +
      hidden_field("key", context.form_key) + hidden_field("kind", "diagnose");
  if (models.size() == 1) {
    text += hidden_field("model", models[0]);
  } else {
    text += "<label for=\"model\">Robot</label>\n<select id=\"model\" name=\"model\" required>\n";
    for (const std::string& model : models)
      text += fmt::format("<option value=\"{0}\">{0}</option>\n", safe_text(model));
    text += "</select>\n";
  }
  return text +
         "<label for=\"logs\">Logs of this robot: drop them here, or choose files</label>\n<input id=\"logs\" "
         "name=\"log\" type=\"file\" multiple required>\n<label for=\"files\">Several files are</label>\n"
         "<select id=\"files\" name=\"files\"><option value=\"single\">a run each</option>\n"
         "<option value=\"columns\">one run: each has other columns</option>\n"
         "<option value=\"rows\">one run: each goes on where the one before ends</option></select>\n"
         "<p><button class=\"main\">Diagnose</button></p>\n"
         "<progress max=\"1\" value=\"0\" hidden aria-label=\"Sending\"></progress>\n<p role=\"status\"></p>\n"
         "</form>\n";
}

std::string home_page(const PageContext& context, const std::vector<ServedRobot>& robots,
                      const std::vector<std::string>& without_cases, const std::vector<Job>& latest) {
  std::string text = "<h1>Robots</h1>\n";
  std::vector<std::string> models;
  for (const ServedRobot& robot : robots) models.push_back(robot.model);
  if (robots.empty())
    text +=
        "<p>This folder holds no model yet. <a href=\"/learn\">Learn a robot</a> from logs of healthy runs, or "
        "copy a model and its case base, as faultline learn writes them, into the folder.</p>\n";
  else
    text += drop_form(context, models) + robots_table(robots);
  for (const std::string& name : without_cases)
    text += fmt::format(
        "<p>{0} is not listed: its case base {1} is missing; copy it into the folder, as faultline learn wrote "
        "it.</p>\n",
        safe_text(name), safe_text(case_base_path(name)));
  if (!latest.empty()) text += "<h2>Latest</h2>\n" + job_table(latest, true);
  return service_page(context, "Robots", text);
}

}  // namespace faultline
