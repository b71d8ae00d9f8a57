// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>

#include "apps/commands.hpp"
#include "apps/options.hpp"
#include "apps/terminal.hpp"
#include "apps/work/conversion.hpp"
#include "apps/work/diagnosis_recording.hpp"
#include "apps/work/file_use.hpp"
#include "formats/log_formats.hpp"
#include "formats/open_log.hpp"
#include "lib/core/text.hpp"
#include "lib/robot/chain.hpp"
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

void report(const Conversion& done, const ConvertArguments& arguments) {
  for (const Issue& issue : done.issues.all())
    print_message(fmt::format("{}: {} {}{}: {}", arguments.log, to_string(issue.severity), issue.code,
                              issue.count > 1 ? fmt::format(" ({} times)", issue.count) : "", issue.message));
  if (arguments.out == "-") return;
  print(printable(fmt::format("{}: {} of {} rows of {}", arguments.out, done.rows_written, done.rows_read,
                              arguments.log)) +
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
    const Robot robot = load_robot_file(arguments.robot);
    options.columns = robot.log.columns;
    options.recording = robot.log.recording;
    options.slides = sliding_joints(robot.chain);
  }
  std::optional<std::vector<LogEvent>> events;
  if (!arguments.diagnosis.empty()) events = events_of_file(arguments.diagnosis);
  const auto log = open_log(arguments.log, options);
  const Conversion done = [&] {
    ProgressBar bar(color);
    return convert_log(*log, arguments.out, events, bar.callback());
  }();
  report(done, arguments);
  return done.lost_values ? kFindings : kNothingFound;
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
