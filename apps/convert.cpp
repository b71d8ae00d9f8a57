// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/commands.hpp"
#include "apps/options.hpp"
#include "apps/terminal.hpp"
#include "apps/work/diagnosis_recording.hpp"
#include "apps/work/file_use.hpp"
#include "formats/log_formats.hpp"
#include "formats/log_writer.hpp"
#include "formats/open_log.hpp"
#include "formats/provenance.hpp"
#include "lib/core/error.hpp"
#include "lib/core/text.hpp"
#include "lib/robot/robot_file.hpp"

namespace faultline {
namespace {

struct ConvertArguments {
  std::string log;
  std::string out;
  std::string robot;
  std::string diagnosis;
  LogSelection parts;
};

/// Returns ".csv (- for standard output) or .flog".
std::string written_extensions() {
  std::vector<std::string> extensions;
  for (const LogFormat& format : written_formats()) extensions.push_back(format.extensions.front());
  extensions.front() += " (- for standard output)";
  return either_of(extensions);
}

void copy_rows(LogSource& source, LogWriter& writer, const Progress& progress) {
  Log segment;
  while (source.next(segment)) {
    writer.write(segment);
    if (progress) progress("converting " + source.identity().path, source.share_read());
  }
}

void report_losses(const LogSource& source, const ConvertArguments& arguments) {
  for (const Issue& issue : source.issues().all())
    print_message(fmt::format("{}: {} {}{}: {}", arguments.log, to_string(issue.severity), issue.code,
                              issue.count > 1 ? fmt::format(" ({} times)", issue.count) : "", issue.message));
  if (arguments.out == "-") return;
  const auto& log = source.identity();
  print(printable(fmt::format("{}: {} of {} rows of {}", arguments.out,
                              log.rows_read - source.issues().rows_dropped(), log.rows_read, arguments.log)) +
        "\n");
}

int convert(const ConvertArguments& arguments, ColorChoice color) {
  FileUse()
      .reads("the log", arguments.log)
      .reads("a part of the log", files_of(arguments.parts))
      .reads("the robot file", arguments.robot)
      .reads("the diagnosis", arguments.diagnosis)
      .writes("OUT", arguments.out)
      .claim();
  OpenLogOptions options;
  options.parts = arguments.parts;
  options.parts.hashed = false;  // provenance computes it if needed
  if (!arguments.robot.empty()) {
    const LogMeaning meaning = load_robot_file(arguments.robot).log;
    options.columns = meaning.columns;
    options.recording = meaning.recording;
  }
  std::vector<LogEvent> events;
  if (!arguments.diagnosis.empty()) events = events_of_file(arguments.diagnosis);
  const auto source = open_log(arguments.log, options);
  const auto writer = create_log(arguments.out);
  {
    ProgressBar bar(color);
    copy_rows(*source, *writer, bar.callback());
  }
  if (!arguments.diagnosis.empty() && !writer->note_events(events))
    throw Error(ErrorCode::usage, "--diagnosis", "only a log written as .mcap can hold events");
  const std::string provenance = provenance_of(*source);
  if (!provenance.empty()) writer->note_provenance(provenance);
  writer->commit();
  report_losses(*source, arguments);
  return provenance.empty() ? kNothingFound : kFindings;
}

}  // namespace

void add_convert(CLI::App& app, Program& program) {
  auto arguments = std::make_shared<ConvertArguments>();
  CLI::App* command =
      app.add_subcommand("convert", "Write a log in another format, its columns as channels in SI units");
  command->add_option("LOG", arguments->log, "The log to read")->required();
  command->add_option("OUT", arguments->out, "The file to write: " + written_extensions())->required();
  command->add_option("--robot", arguments->robot, "Robot file that defines what the columns mean")
      ->type_name("ROBOT.toml");
  command
      ->add_option("--diagnosis", arguments->diagnosis,
                   "A diagnosis of this log, whose events are written into a .mcap")
      ->type_name("REPORT.json");
  add_log_selection(*command, arguments->parts);
  command->footer(
      "The converted log needs no column mapping. Rows without a usable time are left out and reported.\n"
      "Exit status 1: rows, values or signals were lost; the converted log records this, too.\n"
      "Example: faultline convert run.csv run.flog --robot robot.toml");
  set_work(*command, program, [arguments](ColorChoice color) { return convert(*arguments, color); });
}

}  // namespace faultline
