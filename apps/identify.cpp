// SPDX-License-Identifier: MIT
#include "lib/identify/identify.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/commands.hpp"
#include "apps/options.hpp"
#include "apps/terminal.hpp"
#include "apps/work/file_use.hpp"
#include "apps/work/robot_log.hpp"
#include "lib/core/atomic_file.hpp"
#include "lib/core/error.hpp"
#include "lib/core/outgoing/json_text.hpp"
#include "lib/identify/excitation/suggest_motion.hpp"
#include "lib/identify/identification_json.hpp"
#include "lib/plausibility/plausible_units.hpp"
#include "lib/report/html/identification/identification_page.hpp"
#include "lib/report/identification_text.hpp"
#include "lib/robot/robot_file.hpp"

namespace faultline {
namespace {

struct IdentifyArguments {
  std::vector<std::string> logs;
  std::string robot;
  std::string output;
  std::string json;
  std::string html;
  std::string suggest;
  std::string pictures;
  bool force = false;
  IdentifyOptions options;
};

constexpr std::array kMethods{IdentifyMethod::automatic, IdentifyMethod::weak_form,
                              IdentifyMethod::output_error};

/// Returns the path of the identified robot relative to the folder of the spec file `spec`.
std::string robot_beside(const std::string& robot, const std::string& spec) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::absolute(spec).lexically_normal().parent_path();
  return fs::absolute(robot).lexically_normal().lexically_relative(folder).generic_string();
}

/// Writes the suggested motion; returns a sentence about it.
std::string suggest(const Identification& id, const IdentifyArguments& arguments) {
  const SuggestedMotion motion = suggest_motion(id, {.threads = arguments.options.threads});
  write_file(arguments.suggest, suggestion_text(motion, robot_beside(arguments.output, arguments.suggest)));
  return fmt::format("suggested motion: condition number {:.3g}, that of the logs is {:.3g}\n",
                     motion.condition, motion.condition_of_logs);
}

void write_pictures(const Identification& id, const std::string& folder) {
  std::filesystem::create_directories(folder);
  for (const NamedPlot& plot : identification_figures(id))
    write_file((std::filesystem::path(folder) / (plot.name + ".svg")).string(), render_svg(plot.plot));
}

void check_outputs(const IdentifyArguments& arguments) {
  FileUse()
      .reads("the log", arguments.logs)
      .reads("the robot file", arguments.robot)
      .writes("-o", arguments.output)
      .writes("--json", arguments.json)
      .writes("--html", arguments.html)
      .writes("--suggest", arguments.suggest)
      .writes_below("--pictures", arguments.pictures, ".svg")
      .claim();
  if (!arguments.suggest.empty() && arguments.output == "-")
    throw Error(
        ErrorCode::usage, "--suggest",
        "the suggested motion refers to the identified robot's file, but -o is standard output; give -o a "
        "file");
}

int run_identify(const IdentifyArguments& arguments, ColorChoice color) {
  check_outputs(arguments);
  const Robot robot = load_robot_file(arguments.robot);
  std::vector<std::unique_ptr<LogSource>> sources;
  std::vector<LogSource*> logs;
  for (const std::string& path : arguments.logs) {
    sources.push_back(open_robot_log(path, robot));
    logs.push_back(sources.back().get());
  }
  if (!arguments.force) refuse_implausible_units(logs, robot);
  ProgressBar bar(color);
  const Identification id = identify(logs, robot, arguments.options, bar.callback());
  if (!arguments.output.empty()) write_file(arguments.output, robot_text_for(arguments.output, id.robot));
  if (!arguments.json.empty()) write_file(arguments.json, json_text(to_json(id)));
  if (!arguments.html.empty()) write_file(arguments.html, render_identification_html(id));
  if (!arguments.pictures.empty()) write_pictures(id, arguments.pictures);
  const std::string suggested = arguments.suggest.empty() ? "" : suggest(id, arguments);
  if (arguments.json != "-" && arguments.output != "-" && arguments.html != "-" && arguments.suggest != "-")
    print(identification_text(id) + suggested);
  return id.status == IdentificationStatus::unexplained ? kFindings : kNothingFound;
}

}  // namespace

void add_identify(CLI::App& app, Program& program) {
  auto arguments = std::make_shared<IdentifyArguments>();
  CLI::App* command =
      app.add_subcommand("identify", "Identify a robot's parameters from logs of healthy runs");
  command->add_option("LOG", arguments->logs, "Logs of healthy runs of one robot")->required();
  command->add_option("--robot", arguments->robot, "Robot file, TOML or URDF, or the axes alone, such as RRP")
      ->required();
  command
      ->add_option("-o,--output", arguments->output,
                   "Write the identified robot file here, URDF for .urdf; - is standard output")
      ->required();
  command->add_option("--json", arguments->json, "Write the identification as JSON; - is standard output");
  add_file_option(*command, "--html", arguments->html, "Write a page with plots");
  command->add_option("--pictures", arguments->pictures, "Write the page's plots into this folder, as SVG");
  add_file_option(*command, "--suggest", arguments->suggest,
                  "Write a motion that excites the parameters better, as a spec for faultline simulate");
  add_choice_option(*command, "--method", arguments->options.method, kMethods,
                    "automatic, weak_form or output_error");
  command->add_flag("--keep-all", arguments->options.keep_all, "Also use logs that disagree with the others");
  command->add_flag(
      "--force", arguments->force,
      "Also use logs whose numbers are implausible in their units, such as degrees read as radians");
  add_threads_option(*command, arguments->options.threads)->default_str("");
  command->footer(
      "Exit status 0: identified, 1: this robot does not explain the logs (unexplained).\n"
      "Example: faultline identify healthy1.csv healthy2.csv --robot robot.toml -o identified.toml");
  set_work(*command, program, [arguments](ColorChoice color) { return run_identify(*arguments, color); });
}

}  // namespace faultline
