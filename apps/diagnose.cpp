// SPDX-License-Identifier: MIT
#include "lib/diagnose/diagnose.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/commands.hpp"
#include "apps/options.hpp"
#include "apps/terminal.hpp"
#include "apps/work/diagnosis_recording.hpp"
#include "apps/work/file_use.hpp"
#include "apps/work/robot_log.hpp"
#include "apps/work/stop_moment.hpp"
#include "lib/core/atomic_file.hpp"
#include "lib/core/error.hpp"
#include "lib/log/prefetch.hpp"
#include "lib/log/transformed/watched_source.hpp"
#include "lib/model/model_files.hpp"
#include "lib/report/html/html_report.hpp"
#include "lib/report/text.hpp"

namespace faultline {
namespace {

constexpr const char* kRecordingOption = "--mcap";

/// A report that the user may request.
struct RequestedReport {
  const ReportFormat* format;
  std::string path{};  ///< - for standard output; empty: not requested
};

/// Returns every format of reports, none requested.
std::vector<RequestedReport> all_reports() {
  std::vector<RequestedReport> reports;
  for (const ReportFormat& format : report_formats()) reports.push_back({&format});
  return reports;
}

/// Adds an option for each, such as --json F. `reports` must not move until the command was parsed.
void add_report_options(CLI::App& command, std::vector<RequestedReport>& reports) {
  for (RequestedReport& report : reports)
    add_file_option(command, std::string("--") + report.format->name, report.path,
                    std::string("Write ") + report.format->what);
}

/// True when a report goes to standard output.
bool standard_output_is_taken(const std::vector<RequestedReport>& reports) {
  return std::any_of(reports.begin(), reports.end(),
                     [](const RequestedReport& report) { return report.path == "-"; });
}

/// Writes the requested reports; those that need a second pass over the log come last.
void write_reports(const std::vector<RequestedReport>& reports, const ReportSource& source) {
  for (const bool second_pass : {false, true})
    for (const RequestedReport& report : reports)
      if (!report.path.empty() && report.format->second_pass == second_pass)
        write_file(report.path, report.format->render(source));
}

struct DiagnoseArguments : ModelPaths {
  std::string log;
  LogSelection parts;
  std::vector<RequestedReport> reports = all_reports();
  std::string recording;  ///< of --mcap
  std::string moment;     ///< of --at
  std::string stop;       ///< of --stop: column; empty: that of the robot file, if it names one
  DiagnoseOptions options;
};

void claim_files(const DiagnoseArguments& arguments) {
  FileUse files;
  files.reads("the log", arguments.log)
      .reads("a part of the log", files_of(arguments.parts))
      .reads(arguments);
  for (const RequestedReport& report : arguments.reports)
    files.writes(std::string("--") + report.format->name, report.path);
  files.writes(kRecordingOption, arguments.recording).claim();
}

int run_diagnose(const DiagnoseArguments& arguments, ColorChoice color) {
  if (arguments.recording == "-")
    throw Error(ErrorCode::usage, kRecordingOption,
                "cannot write to standard output; give the name of a file");
  claim_files(arguments);
  const ModelFiles files = load_model_files(arguments.model, arguments.case_base());
  const Model& model = files.model;
  DiagnoseOptions options = arguments.options;
  options.stop = stop_question(stop_log(arguments.log, arguments.parts, model.robot.log.recording),
                               model.robot, arguments.moment, arguments.stop);
  std::optional<ProgressBar> bar(std::in_place, color);
  std::string step = "diagnosing " + arguments.log;
  const auto log =
      watched_log(prefetched(open_robot_log(arguments.log, model.robot, arguments.parts)), [&](double share) {
        if (bar) bar->callback()(step, share);
      });
  const Diagnosis diagnosis = diagnose(*log, model, files.cases, options);
  step = "writing what was found in " + arguments.log;
  if (standard_output_is_taken(arguments.reports)) bar.reset();
  const auto tell_diagnosis = [&] {
    bar.reset();
    TimelineOptions timeline;
    timeline.color = use_color(color, stdout);
    if (!standard_output_is_taken(arguments.reports)) print(render_text(diagnosis, timeline), timeline.color);
  };
  write_reports(arguments.reports, report_source(*log, model, diagnosis, options));
  try {
    if (!arguments.recording.empty()) write_recording(arguments.recording, *log, model, diagnosis);
  } catch (const Error&) {
    tell_diagnosis();  // the diagnosis is valid even if the log cannot be a recording, as it begins before 0
    throw;
  }
  tell_diagnosis();
  return diagnosis.verdict == Verdict::healthy ? kNothingFound : kFindings;
}

}  // namespace

void add_diagnose(CLI::App& app, Program& program) {
  auto arguments = std::make_shared<DiagnoseArguments>();
  CLI::App* command = app.add_subcommand("diagnose", "Find the faults in one log: kind, joint and time");
  command->add_option("LOG", arguments->log, "The log of the run")->required();
  add_model_option(*command, *arguments)->required();
  add_cases_option(*command, *arguments);
  add_report_options(*command, arguments->reports);
  command
      ->add_option(
          kRecordingOption, arguments->recording,
          "Write the log with predictions, residuals, evidence and events as MCAP (Foxglove, PlotJuggler)")
      ->type_name("F");
  command
      ->add_option(
          "--at", arguments->moment,
          "Moment of a stop: the report says what changed before it. Seconds in the time of the log, or "
          "a date with a time (2026-11-24T08:15:30.2Z)")
      ->type_name("TIME");
  command
      ->add_option(
          "--stop", arguments->stop,
          "Column whose first change is the stop, such as the controller's stop flag; by default that "
          "of stop in [log.columns] of the robot file")
      ->type_name("COLUMN");
  add_diagnose_options(*command, arguments->options);
  add_log_selection(*command, arguments->parts);
  command->footer(
      "Exit status 0: healthy, 1: a fault was found, or no verdict is possible (\"No verdict\", verdict "
      "inconclusive).\n"
      "Example: faultline diagnose run.csv --model robot.model --json report.json");
  set_work(*command, program, [arguments](ColorChoice color) { return run_diagnose(*arguments, color); });
}

}  // namespace faultline
