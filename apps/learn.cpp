// SPDX-License-Identifier: MIT
#include "lib/learn/learn.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/commands.hpp"
#include "apps/options.hpp"
#include "apps/terminal.hpp"
#include "apps/work/file_use.hpp"
#include "apps/work/learned_text.hpp"
#include "apps/work/learning.hpp"
#include "apps/work/robot_log.hpp"
#include "lib/core/atomic_file.hpp"
#include "lib/core/text.hpp"
#include "lib/model/twin/twin_options.hpp"
#include "lib/robot/robot_file.hpp"

namespace faultline {
namespace {

struct LearnArguments : ModelPaths {
  std::vector<std::string> logs;
  std::string robot, labels, json;
  bool show_twin = false;
  LearnOptions options;
};

OpenLogs open_logs(const LearnArguments& arguments, const Robot& robot) {
  std::vector<LogLabel> labels;
  if (!arguments.labels.empty()) labels = read_labels(arguments.labels);
  OpenLogs open;
  for (const std::string& log : arguments.logs)
    if (!open.add(log, open_robot_log(log, robot), labels, robot))
      print_message(printable(log) + " is not named in " + printable(arguments.labels) +
                    "; it counts as healthy");
  open.require_healthy();
  return open;
}

void claim_files(const LearnArguments& arguments) {
  FileUse()
      .reads("the log", arguments.logs)
      .reads("the robot file", arguments.robot)
      .reads("the labels", arguments.labels)
      .writes("-o", arguments.model)
      .writes_case_base("--cases", arguments.case_base())
      .writes("--json", arguments.json)
      .claim();
}

int show_twin(const LearnArguments& arguments) {
  const nlohmann::ordered_json json{{"schema", "faultline/twin/1"},
                                    {"twin", twin_to_json(arguments.options.twin)}};
  if (!arguments.json.empty()) write_file(arguments.json, json.dump(2) + "\n");
  if (arguments.json != "-") print(twin_text(arguments.options.twin));
  return kNothingFound;
}

int run_learn(const LearnArguments& arguments, ColorChoice color) {
  claim_files(arguments);
  const Robot robot = load_robot_file(arguments.robot);
  const OpenLogs logs = open_logs(arguments, robot);
  check_writable(arguments, robot);
  ProgressBar bar(color);
  Learned learned = learn(logs.healthy, logs.labelled, robot, arguments.options, bar.callback());
  const std::optional<CarriedCases> carried = write_model(learned.model, learned.cases, arguments);
  if (!arguments.json.empty()) write_file(arguments.json, learned_json(learned, carried));
  if (arguments.json != "-")
    print(learned_text(learned, arguments.model, arguments.case_base()) + carried_text(carried));
  return kNothingFound;
}

}  // namespace

void add_learn(CLI::App& app, Program& program) {
  auto arguments = std::make_shared<LearnArguments>();
  CLI::App* command = app.add_subcommand("learn", "Learn a model of one robot from logs of healthy runs");
  command
      ->add_option("LOG", arguments->logs,
                   "Logs of healthy runs, and labelled ones of faults if there are any")
      ->required();
  command->add_option("--robot", arguments->robot, "Robot file, TOML or URDF, or the axes alone, such as RRP")
      ->required()
      ->type_name("ROBOT");
  command->add_option("--labels", arguments->labels, "Which logs show which fault: file,fault,joint,onset_s")
      ->type_name("LABELS.csv");
  command->add_option("-o,--output", arguments->model, "The model to write")->required()->type_name("MODEL");
  add_cases_option(*command, *arguments, "The case base to write");
  add_file_option(*command, "--json", arguments->json, "Write a summary as JSON",
                  " to this file, - for standard output");
  command
      ->add_option("--runs-per-label", arguments->options.runs_per_label,
                   "Simulated runs for each fault and joint that the networks learn from, at least 2")
      ->capture_default_str();
  command
      ->add_option("--alarms-per-hour", arguments->options.alarms_per_hour,
                   "Accepted number of false alarms by chance per hour of healthy log")
      ->capture_default_str();
  command->add_flag("--keep-all", arguments->options.identify.keep_all,
                    "Also learn from logs that contradict the others");
  command->add_flag("--force", arguments->options.keep_doubtful,
                    "Write the model even if it failed its checks; each diagnosis then reports it as "
                    "doubtful");
  command->add_option("--seed", arguments->options.seed, "Seed of all random choices")->capture_default_str();
  add_threads_option(*command, arguments->options.threads);
  command->add_flag_callback(
      "--show-twin",
      [arguments, command] {
        arguments->show_twin = true;
        for (CLI::Option* option : command->get_options()) option->required(false);
      },
      "Show how the faults to learn from are simulated, and do nothing else; needs no other argument");
  command->footer("Example: faultline learn healthy_*.csv --robot robot.toml -o robot.model");
  command->callback([arguments, &program] {
    if (arguments->show_twin) {
      program.run = [arguments] { return show_twin(*arguments); };
      return;
    }
    arguments->options.identify.threads = arguments->options.threads;
    program.run = [arguments, &program] { return run_learn(*arguments, program.color); };
  });
}

}  // namespace faultline
