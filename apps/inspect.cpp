// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <memory>

#include "apps/commands.hpp"
#include "apps/inspection/inspection.hpp"
#include "apps/options.hpp"
#include "apps/suggestion/robot_guess.hpp"
#include "apps/terminal.hpp"
#include "apps/work/file_use.hpp"
#include "lib/core/atomic_file.hpp"
#include "lib/core/error.hpp"
#include "lib/robot/robot_file.hpp"

namespace faultline {
namespace {

struct InspectArguments {
  std::vector<std::string> logs;
  std::string robot;
  std::string json;
  LogSelection parts;
  std::string html;
  std::string suggest;
};

/// Inspects the logs; an unreadable one is reported on standard error and does not stop the others.
std::vector<Inspection> inspect_all(const InspectArguments& arguments, ColorChoice color, int& status) {
  std::optional<Robot> robot;
  if (!arguments.robot.empty()) robot = load_robot_file(arguments.robot);
  std::vector<Inspection> inspections;
  LogSelection parts = arguments.parts;
  parts.hashed = !arguments.json.empty() || !arguments.html.empty();
  for (const std::string& log : arguments.logs) {
    const int result = guarded([&] {
      ProgressBar bar(color);
      inspections.push_back(inspect_log(log, robot, bar.callback(), parts));
      return inspections.back().severe() ? kFindings : kNothingFound;
    });
    status = std::max(status, result);
  }
  return inspections;
}

/// Writes the suggested robot file. Throws as loading it would; then nothing is written.
void suggest_robot(const InspectArguments& arguments) {
  if (arguments.logs.size() != 1)
    throw Error(ErrorCode::usage, "--suggest", "takes one log; give the one with most motion");
  const RawExcerpt excerpt = raw_excerpt(arguments.logs.front());
  const std::string text = robot_guess_text(guess_robot(excerpt), excerpt);
  robot_from_toml(text, arguments.suggest);
  write_file(arguments.suggest, text);
}

int inspect(const InspectArguments& arguments, ColorChoice color) {
  FileUse()
      .reads("the log", arguments.logs)
      .reads("a part of the log", files_of(arguments.parts))
      .reads("the robot file", arguments.robot)
      .writes("--json", arguments.json)
      .writes("--html", arguments.html)
      .writes("--suggest", arguments.suggest)
      .claim();
  if (!arguments.suggest.empty()) suggest_robot(arguments);
  if (arguments.suggest == "-") return kNothingFound;
  int status = kNothingFound;
  const auto inspections = inspect_all(arguments, color, status);
  if (!arguments.json.empty()) write_file(arguments.json, inspections_json(inspections));
  if (!arguments.html.empty() && !inspections.empty())
    write_file(arguments.html, inspection_page(inspections));
  const bool in_color = use_color(color, stdout);
  if (arguments.json != "-" && arguments.html != "-")
    for (const Inspection& inspection : inspections) print(inspection_text(inspection, in_color), in_color);
  return status;
}

}  // namespace

void add_inspect(CLI::App& app, Program& program) {
  auto arguments = std::make_shared<InspectArguments>();
  CLI::App* command = app.add_subcommand("inspect", "Report what logs contain and what is wrong with them");
  command->add_option("LOG", arguments->logs, "Log files")->required();
  command->add_option("--robot", arguments->robot, "Robot file that defines what the columns mean")
      ->type_name("ROBOT.toml");
  add_file_option(*command, "--json", arguments->json, "Write the findings as JSON",
                  " to this file, - for standard output");
  add_log_selection(*command, arguments->parts);
  add_file_option(*command, "--html", arguments->html, "Write a page with pictures of all channels",
                  " to this file, - for standard output");
  add_file_option(*command, "--suggest", arguments->suggest,
                  "Write a robot file guessed from names, units and data of the log",
                  "; - for standard output, without the report");
  command->footer(
      "Exit status 1 when something severe was found.\n"
      "Example: faultline inspect run.csv --robot robot.toml --json findings.json");
  set_work(*command, program, [arguments](ColorChoice color) { return inspect(*arguments, color); });
}

}  // namespace faultline
