// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <array>

#include "apps/service/pages/pages.hpp"
#include "apps/service/report_facts.hpp"
#include "lib/core/number_text.hpp"
#include "lib/core/text.hpp"
#include "lib/fault/fault_catalogue.hpp"

namespace faultline {
namespace {

std::string button_form(const PageContext& context, const Job& job, const char* action, const char* words) {
  return fmt::format("<form method=\"post\" action=\"{}/{}\">{}<button>{}</button></form>\n",
                     job_address(job.id), action, hidden_field("key", context.form_key), words);
}

std::string file_link(const Job& job, const char* name, const char* words, const char* look = "button") {
  return fmt::format("<a class=\"{}\" href=\"{}/{}\">{}</a>\n", look, job_address(job.id), name, words);
}

std::string progress_part(const PageContext& context, const Job& job, std::size_t before) {
  const std::string value = job.share >= 0.0 ? fmt::format(" value=\"{:.2f}\"", job.share) : "";
  return fmt::format(
             "<div data-job=\"{}\"><progress max=\"1\"{} aria-label=\"Progress\"></progress>\n<p "
             "role=\"status\">{}</p></div>\n<noscript><p><a href=\"{}\">Look again</a></p></noscript>\n",
             job.id, value, safe_text(progress_sentence(job, before)), job_address(job.id)) +
         "<div class=\"actions\">" + button_form(context, job, "cancel", "Cancel") + "</div>\n";
}

std::string kind_options(FaultKind chosen) {
  std::string text;
  for (int i = 1; i < kFaultKinds; ++i) {
    const auto kind = static_cast<FaultKind>(i);
    text += fmt::format("<option value=\"{}\"{}>{}</option>\n", to_string(kind),
                        chosen == kind ? " selected" : "", describe(kind).heading);
  }
  return text;
}

std::string joint_options(int joints, int chosen) {
  std::string text = "<option value=\"0\">none</option>\n";
  for (int joint = 1; joint <= joints; ++joint)
    text += fmt::format("<option value=\"{0}\"{1}>{0}</option>\n", joint, joint == chosen ? " selected" : "");
  return text;
}

std::string labelled(const std::string& id, const char* label, const std::string& control) {
  return fmt::format("<div><label for=\"{}\">{}</label>\n{}</div>\n", id, label, control);
}

/// The question what a fault really was; the answer becomes a case.
std::string case_form(const PageContext& context, const Job& job, const ReportedFault& fault, int joints) {
  const int id = fault.id;
  const auto name = [id](const char* field) { return fmt::format("{}-{}", field, id); };
  const auto select = [&](const char* field, const std::string& options) {
    return fmt::format("<select id=\"{}\" name=\"{}\">\n{}</select>", name(field), field, options);
  };
  const auto input = [&](const char* field) {
    return fmt::format("<input id=\"{}\" name=\"{}\" maxlength=\"500\">", name(field), field);
  };
  return fmt::format(
             "<details><summary>What was it?</summary>\n<form class=\"case\" method=\"post\" action=\"{}/case\">\n",
             job_address(job.id)) +
         hidden_field("key", context.form_key) + hidden_field("fault_id", std::to_string(id)) +
         "<div class=\"row\">" +
         labelled(name("kind"), "Fault", select("kind", kind_options(fault.label.kind))) +
         labelled(name("joint"), "Joint",
                  select("joint", joint_options(joints, fault.label.joint.number()))) +
         labelled(name("done"), "What was done", input("done")) +
         labelled(name("by"), "By whom", input("by")) +
         "</div>\n<p><button class=\"main\">Store as a case</button></p>\n</form></details>\n";
}

std::string fault_part(const PageContext& context, const Job& job, const ReportFacts& report,
                       const ReportedFault& fault, const std::vector<StatedCase>& stated) {
  std::string text = fmt::format(
      "<section class=\"finding\"><h2>Fault {}: {}</h2>\n<p>From {} on, confidence {}.</p>\n<p>{}</p>\n",
      fault.id, safe_text(plain_words(fault.label)), time_text(fault.onset_s, report.sample_period_s),
      percent_text(fault.confidence), safe_text(fault.next_check));
  for (const StatedCase& one : stated)
    if (one.fault_id == fault.id) text += fmt::format("<p>Stored: {}</p>\n", safe_text(one.text));
  return text + case_form(context, job, fault, report.joints) + "</section>\n";
}

std::string recording_action(const PageContext& context, const Job& job, const std::vector<Job>& recordings) {
  for (const Job& recording : recordings)
    if (recording.outcome.state == JobState::done)
      return file_link(recording, kRecording, "Recording (MCAP)");
  for (const Job& recording : recordings)
    if (!recording.has_ended())
      return fmt::format("<a class=\"button\" href=\"{}\">The recording is being made</a>\n",
                         job_address(recording.id));
  return button_form(context, job, "record", "Make a recording (MCAP)");
}

std::string diagnosis_part(const PageContext& context, const Job& job, const JobFiles& files) {
  const ReportFacts report = report_facts(files.report);
  std::string text = fmt::format("<p class=\"verdict {0}\">{0}: {1}</p>\n", safe_text(job.outcome.verdict),
                                 safe_text(job.outcome.sentence));
  text += "<div class=\"actions\">" + file_link(job, kReportPage, "Open the report", "button main") +
          file_link(job, kReportJson, "JSON") + recording_action(context, job, files.recordings) +
          file_link(job, "log", "The log") + "</div>\n";
  for (const ReportedFault& fault : report.faults)
    text += fault_part(context, job, report, fault, files.stated);
  return text;
}

std::string suggestion_part(const PageContext& context, const Job& job, const JobFiles& files) {
  return "<p>Look at this robot file: axes, units and what the columns mean. Correct what is wrong; lines that "
         "begin with # say what could not be guessed.</p>\n<form method=\"post\" action=\"/jobs\" "
         "enctype=\"multipart/form-data\">\n" +
         hidden_field("key", context.form_key) + hidden_field("kind", "learn") +
         hidden_field("of", std::to_string(job.id)) +
         "<label for=\"name\">Name of the robot: letters, digits, - and _</label>\n<input id=\"name\" name=\"name\" "
         "pattern=\"[A-Za-z0-9_\\-]{1,60}\" maxlength=\"60\" required>\n<label for=\"robot\">Robot file</label>\n"
         "<textarea id=\"robot\" name=\"robot\" spellcheck=\"false\" required>" +
         escaped_markup(files.robot_file) +
         "</textarea>\n<p><button class=\"main\">Learn the robot</button></p>\n</form>\n";
}

std::string result_part(const PageContext& context, const Job& job, const JobFiles& files) {
  switch (job.request.kind) {
    case JobKind::diagnose:
      return diagnosis_part(context, job, files);
    case JobKind::record:
      return "<div class=\"actions\">" + file_link(job, kRecording, "Recording (MCAP)", "button main") +
             "</div>\n";
    case JobKind::suggest:
      return suggestion_part(context, job, files);
    case JobKind::learn:
      return fmt::format("<p>The robot is ready: <a href=\"{}\">{}</a>.</p>\n<pre>{}</pre>\n",
                         robot_address(job.request.model), safe_text(job.request.model),
                         escaped_markup(files.answer));
    case JobKind::compare:
      return "<div class=\"actions\">" +
             file_link(job, kComparisonPage, "Open the comparison", "button main") +
             fmt::format("</div>\n<pre>{}</pre>\n", escaped_markup(files.answer));
  }
  return "";
}

std::string failure_part(const Job& job) {
  std::string text = fmt::format("<p role=\"alert\" class=\"verdict inconclusive\">{}</p>\n",
                                 safe_text(job.outcome.sentence));
  if (job.request.kind == JobKind::learn)
    text +=
        fmt::format("<p><a href=\"{}\">Correct the robot file</a></p>\n", job_address(job.request.of.at(0)));
  return text;
}

}  // namespace

std::string progress_sentence(const Job& job, std::size_t before) {
  if (!job.running)
    return before == 0
               ? "Waiting: this job is next."
               : fmt::format("Waiting: {} before this one.", counted(static_cast<long long>(before), "job"));
  if (job.share < 0.0) return "Running.";
  return fmt::format("Running: {}, {}", percent_text(job.share), job.step);
}

std::string job_page(const PageContext& context, const Job& job, const JobFiles& files) {
  const std::string title = title_of(job);
  std::string text = fmt::format("<h1>{}</h1>\n<p class=\"sub\">", safe_text(title));
  if (!job.request.model.empty())
    text += fmt::format("robot <a href=\"{}\">{}</a>, ", robot_address(job.request.model),
                        safe_text(job.request.model));
  text += fmt::format("job {}, received {}</p>\n", job.id, moment_text(job.request.received_s));
  if (!job.has_ended())
    text += progress_part(context, job, files.before);
  else if (job.outcome.state == JobState::done)
    text += result_part(context, job, files);
  else
    text += failure_part(job);
  if (job.has_ended())
    text += "<div class=\"actions\">" + button_form(context, job, "delete", "Delete this job and its files") +
            "</div>\n";
  return service_page(context, title, text);
}

}  // namespace faultline
