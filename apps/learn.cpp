// SPDX-License-Identifier: MIT
#include "lib/pipeline/learn.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "apps/commands.hpp"
#include "apps/exit_status.hpp"
#include "apps/labels.hpp"
#include "apps/progress.hpp"
#include "formats/open_log.hpp"
#include "lib/cases/case_file.hpp"
#include "lib/core/atomic_file.hpp"
#include "lib/core/error.hpp"
#include "lib/core/text.hpp"
#include "lib/identify/identification_json.hpp"
#include "lib/robot/robot_file.hpp"
#include "lib/twin/twin_json.hpp"
#include "lib/twin/twin_text.hpp"

namespace faultline {
namespace {

struct LearnArguments {
  std::vector<std::string> logs;
  std::string robot, labels, model, cases, json;
  bool show_twin = false;
  LearnOptions options;
};

/// The logs that the user named, open, by what they are known to show.
struct OpenLogs {
  std::vector<std::unique_ptr<LogSource>> owners;
  std::vector<LogSource*> healthy;
  std::vector<LabelledLog> labelled;
};

void check_joint(const LogLabel& label, const Robot& robot, const std::string& log) {
  if (label.label.joint > robot.joints())
    throw Error(ErrorCode::input, log,
                fmt::format("is labelled with a fault of joint {}, but the robot has {}", label.label.joint,
                            counted(robot.joints(), "joint")));
}

OpenLogs open_logs(const LearnArguments& arguments, const Robot& robot) {
  std::vector<LogLabel> labels;
  if (!arguments.labels.empty()) labels = read_labels(arguments.labels);
  OpenLogs open;
  OpenLogOptions options;
  options.columns = robot.log.columns;
  options.keep_extra = false;
  for (const std::string& log : arguments.logs) {
    open.owners.push_back(open_log(log, options));
    const LogLabel* label = label_of(labels, log);
    if (label) check_joint(*label, robot, log);
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

std::string delay_text(double seconds) {
  return std::isfinite(seconds) ? fmt::format("{:.3f}", seconds) : "-";
}

std::string validation_text(const Validation& validation) {
  std::string text = fmt::format("{:<18} {:>5} {:>6} {:>6} {:>6} {:>8} {:>10} {:>8}\n", "simulated fault",
                                 "runs", "found", "joint", "both", "or named", "delay/s", "p90/s");
  ValidationRow all;
  for (const ValidationRow& row : validation.rows) {
    text += fmt::format("{:<18} {:>5} {:>6} {:>6} {:>6} {:>8} {:>10} {:>8}\n", to_string(row.kind), row.runs,
                        row.detected, row.right_joint, row.right_kind_and_joint, row.right_or_named,
                        delay_text(row.median_delay_s), delay_text(row.p90_delay_s));
    all.runs += row.runs;
    all.detected += row.detected;
    all.right_joint += row.right_joint;
    all.right_kind_and_joint += row.right_kind_and_joint;
    all.right_or_named += row.right_or_named;
  }
  text += fmt::format("{:<18} {:>5} {:>6} {:>6} {:>6} {:>8}\n", "all", all.runs, all.detected,
                      all.right_joint, all.right_kind_and_joint, all.right_or_named);
  text +=
      fmt::format("False alarms: {} in {:.2f} h of simulated healthy running; alarms before the onset: {}.\n",
                  validation.false_alarms, validation.healthy_hours, validation.early_alarms);
  return text;
}

std::string parameter_text(const Identification& identification) {
  std::string text;
  std::set<std::string> seen;
  auto add = [&](const std::vector<ParameterEstimate>& parameters) {
    for (const ParameterEstimate& p : parameters) {
      if (!seen.insert(p.name).second) continue;
      if (p.identifiable)
        text += fmt::format("  {:<6} {:>11.5g} +- {:<8.2g} {}\n", p.name, p.value,
                            0.5 * (p.ci95[1] - p.ci95[0]), p.unit);
      else
        text += fmt::format("  {:<6} not determined: {}\n", p.name, p.why_not);
    }
  };
  add(identification.physical_parameters);
  add(identification.base_parameters);
  return text;
}

std::string learned_text(const Learned& learned, const LearnArguments& arguments) {
  std::string text = fmt::format("Learned \"{}\" from {} logs at {:.4g} Hz.\n", learned.model.name,
                                 learned.model.sources.size(), 1.0 / learned.model.sample_period_s);
  text += fmt::format("\nIdentified, with 95 % intervals ({}):\n{}", to_string(learned.identification.status),
                      parameter_text(learned.identification));
  text += fmt::format("\nTested on simulated runs of the identified robot that nothing was trained on:\n{}",
                      validation_text(learned.model.validation));
  text += fmt::format("\nModel: {}\nCase base: {} ({} cases)\n", arguments.model, arguments.cases,
                      learned.cases.cases().size());
  return text;
}

std::string learned_json(const Learned& learned) {
  const nlohmann::ordered_json model = nlohmann::ordered_json::parse(model_to_json(learned.model));
  nlohmann::ordered_json json{{"schema", "faultline/learning/1"}, {"name", learned.model.name}};
  json["identification"] = to_json(learned.identification);
  json["identification"].erase("state");
  json["mlp"] = {{"normalised_mse", learned.residual.normalised_mse},
                 {"persistence_mse", learned.residual.persistence_mse}};
  for (const char* key : {"sample_period_s", "sources", "validation", "evidence"}) json[key] = model[key];
  json["cases"] = learned.cases.cases().size();
  return json.dump(2) + "\n";
}

/// Fails before the work begins rather than after it.
void check_writable(const LearnArguments& arguments) {
  const AtomicFile model(arguments.model), cases(arguments.cases);
}

/// Both files or, when the disk is full, neither.
void write_model(const Learned& learned, const LearnArguments& arguments) {
  AtomicFile model(arguments.model);
  model.write(model_to_json(learned.model));
  write_case_base(arguments.cases, learned.cases);
  model.commit();
}

int show_twin(const LearnArguments& arguments) {
  const nlohmann::ordered_json json{{"schema", "faultline/twin/1"},
                                    {"twin", twin_to_json(arguments.options.twin)}};
  if (!arguments.json.empty()) write_file(arguments.json, json.dump(2) + "\n");
  if (arguments.json != "-") print(twin_text(arguments.options.twin));
  return kNothingFound;
}

int run_learn(const LearnArguments& arguments, ColorChoice color) {
  const Robot robot = load_robot_file(arguments.robot);
  const OpenLogs logs = open_logs(arguments, robot);
  check_writable(arguments);
  ProgressBar bar(color);
  const Learned learned = learn(logs.healthy, logs.labelled, robot, arguments.options, bar.callback());
  write_model(learned, arguments);
  if (!arguments.json.empty()) write_file(arguments.json, learned_json(learned));
  if (arguments.json != "-") print(learned_text(learned, arguments));
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
  command->add_option("--robot", arguments->robot, "Robot file")->required()->type_name("ROBOT.toml");
  command->add_option("--labels", arguments->labels, "Which logs show which fault: file,fault,joint,onset_s")
      ->type_name("LABELS.csv");
  command->add_option("-o,--output", arguments->model, "The model to write")->required()->type_name("MODEL");
  command->add_option("--cases", arguments->cases, "The case base to write, MODEL.cases.db by default")
      ->type_name("FILE");
  command
      ->add_option("--json", arguments->json, "Write a summary as JSON to this file, - for standard output")
      ->type_name("F");
  command
      ->add_option("--runs-per-label", arguments->options.runs_per_label,
                   "Simulated runs for each fault and joint that the networks learn from")
      ->capture_default_str();
  command->add_option("--seed", arguments->options.seed, "Of every random choice")->capture_default_str();
  command->add_option("--threads", arguments->options.threads, "0 = one a core; changes no byte")
      ->capture_default_str();
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
    if (arguments->cases.empty()) arguments->cases = arguments->model + ".cases.db";
    arguments->options.identify.threads = arguments->options.threads;
    program.run = [arguments, &program] { return run_learn(*arguments, program.color); };
  });
}

}  // namespace faultline
