// SPDX-License-Identifier: MIT
#include "lib/pipeline/learn.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "apps/carried_cases.hpp"
#include "apps/commands.hpp"
#include "apps/exit_status.hpp"
#include "apps/file_use.hpp"
#include "apps/labels.hpp"
#include "apps/learned_text.hpp"
#include "apps/options.hpp"
#include "apps/progress.hpp"
#include "apps/robot_log.hpp"
#include "lib/cases/case_file.hpp"
#include "lib/cases/possible_labels.hpp"
#include "lib/core/atomic_file.hpp"
#include "lib/core/error.hpp"
#include "lib/core/text.hpp"
#include "lib/robot/robot_file.hpp"
#include "lib/twin/twin_json.hpp"
#include "lib/twin/twin_text.hpp"

namespace faultline {
namespace {

struct LearnArguments : ModelPaths {
  std::vector<std::string> logs;
  std::string robot, labels, json;
  bool show_twin = false;
  LearnOptions options;
};

/// The logs that the user named, open, by what they are known to show.
struct OpenLogs {
  std::vector<std::unique_ptr<LogSource>> owners;
  std::vector<LogSource*> healthy;
  std::vector<LabelledLog> labelled;
};

/// The label of a log, if there is one that this robot can have. Throws Error(usage).
std::optional<LogLabel> checked_label(const std::vector<LogLabel>& labels, const Robot& robot,
                                      const std::string& log) {
  const LogLabel* const found = label_of(labels, log);
  if (!found) return {};
  LogLabel label = *found;
  label.label = with_tip(label.label, robot.joints());
  check_place(robot.joints(), label.label, log + ", by its label");
  return label;
}

OpenLogs open_logs(const LearnArguments& arguments, const Robot& robot) {
  std::vector<LogLabel> labels;
  if (!arguments.labels.empty()) labels = read_labels(arguments.labels);
  OpenLogs open;
  for (const std::string& log : arguments.logs) {
    open.owners.push_back(open_robot_log(log, robot));
    const std::optional<LogLabel> label = checked_label(labels, robot, log);
    if (!label && !labels.empty())
      tell(printable(log) + " is not named in " + printable(arguments.labels) + "; it counts as healthy");
    if (label && label->label.kind != FaultKind::none)
      open.labelled.push_back({open.owners.back().get(), label->label, label->onset_s});
    else
      open.healthy.push_back(open.owners.back().get());
  }
  if (open.healthy.empty())
    throw Error(ErrorCode::usage, "faultline learn",
                "all logs are labelled with faults; at least one log of a healthy run is needed");
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

/// Fails before the work begins rather than after it.
void check_writable(const LearnArguments& arguments, const Robot& robot) {
  const std::string path = arguments.case_base();
  if (has_case_base(path))
    check_can_carry_over(path, robot.joints());
  else
    const AtomicFile cases(path);
  const AtomicFile model(arguments.model);
}

/// The case base first: it alone holds what nothing can make again. A kill between the two leaves two
/// identities, which load_model_files() notices and learning again mends.
std::optional<CarriedCases> write_model(Learned& learned, const LearnArguments& arguments) {
  const std::string text = model_to_json(learned.model);
  model_from_json(text, arguments.model);  // what is written can be read
  AtomicFile model(arguments.model);
  model.write(text);
  std::optional<CarriedCases> carried;
  replace_case_base(arguments.case_base(), [&](const CaseBase* there) {
    if (there) carried = carry_over(*there, learned.cases);
    return learned.cases;
  });
  model.commit();
  return carried;
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
  const std::optional<CarriedCases> carried = write_model(learned, arguments);
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
                   "Simulated runs for each fault and joint that the networks learn from, at least 4")
      ->capture_default_str();
  command
      ->add_option("--alarms-per-hour", arguments->options.alarms_per_hour,
                   "False alarms that chance may raise in an hour of healthy log")
      ->capture_default_str();
  command->add_flag("--keep-all", arguments->options.identify.keep_all,
                    "Also learn from logs that the others contradict");
  command->add_flag("--force", arguments->options.keep_doubtful,
                    "Write a model that is not to be trusted, too; each diagnosis says that it is doubtful");
  command->add_option("--seed", arguments->options.seed, "Of every random choice")->capture_default_str();
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
