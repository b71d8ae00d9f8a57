// SPDX-License-Identifier: MIT
#include "lib/identify/identify.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/commands.hpp"
#include "apps/exit_status.hpp"
#include "apps/options.hpp"
#include "apps/progress.hpp"
#include "apps/robot_log.hpp"
#include "lib/core/atomic_file.hpp"
#include "lib/identify/identification_json.hpp"
#include "lib/robot/robot_file.hpp"

namespace faultline {
namespace {

struct IdentifyArguments {
  std::vector<std::string> logs;
  std::string robot;
  std::string output;
  std::string json;
  IdentifyOptions options;
};

constexpr std::array kMethods{IdentifyMethod::automatic, IdentifyMethod::weak_form,
                              IdentifyMethod::output_error};

std::string row(const ParameterEstimate& e) {
  if (!e.identifiable) return fmt::format("  {:<9} not identifiable: {}\n", e.name, e.why_not);
  if (e.std == 0.0)
    return fmt::format("  {:<9} {:>12.6g}                              {} (given)\n", e.name, e.value,
                       e.unit);
  return fmt::format("  {:<9} {:>12.6g}  [{:.6g}, {:.6g}]  {}{}\n", e.name, e.value, e.ci95[0], e.ci95[1],
                     e.unit, e.meaning.empty() || e.meaning == e.name ? "" : "   = " + e.meaning);
}

std::string table(const Identification& id) {
  std::string text =
      fmt::format("{}: {} by {}; {}\n", id.robot.name, to_string(id.status), to_string(id.method), id.reason);
  text += "base parameters and friction [95 % interval]\n";
  for (const auto& e : id.base_parameters) text += row(e);
  text += "masses and lengths\n";
  for (const auto& e : id.physical_parameters) text += row(e);
  text += "fit\n";
  for (std::size_t j = 0; j < id.fit_r2.size(); ++j)
    text += fmt::format(
        "  joint {}   R2 {:.5f}, held out {:.5f}; torque left over {:.4g} rms, {:.2g} ms late; noise of q "
        "{:.3g}{}\n",
        j + 1, id.fit_r2[j], id.held_out_r2[j], id.residual_rms[j], 1e3 * id.torque_delay_s[j], id.q_noise[j],
        id.dq_noise.empty() ? "" : fmt::format(", of dq {:.3g}", id.dq_noise[j]));
  for (const ModelTerm& t : id.terms)
    text += fmt::format("  {:<9} {}: held-out residual of joint {} {:.4g} without, {:.4g} with it\n", t.name,
                        t.kept ? "pays" : "does not pay", t.joint + 1, t.error_before, t.error_after);
  text += fmt::format("  condition number {:.3g}\n", id.condition_number);
  for (const auto& log : id.logs)
    text += fmt::format("log {}: {} rows, sample period {:.6g} s\n", log.path, log.rows, log.sample_period_s);
  for (const auto& issue : id.issues.all())
    text += fmt::format("{}: {} ({} times)\n", to_string(issue.severity), issue.message, issue.count);
  return text;
}

int run_identify(const IdentifyArguments& arguments, ColorChoice color) {
  const Robot robot = load_robot_file(arguments.robot);
  std::vector<std::unique_ptr<LogSource>> sources;
  std::vector<LogSource*> logs;
  for (const std::string& path : arguments.logs) {
    sources.push_back(open_robot_log(path, robot));
    logs.push_back(sources.back().get());
  }
  ProgressBar bar(color);
  const Identification id = identify(logs, robot, arguments.options, bar.callback());
  if (!arguments.output.empty()) write_file(arguments.output, robot_text_for(arguments.output, id.robot));
  if (!arguments.json.empty()) write_file(arguments.json, to_json(id).dump(2) + "\n");
  if (arguments.json != "-" && arguments.output != "-") print(table(id));
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
  add_choice_option(*command, "--method", arguments->options.method, kMethods,
                    "automatic, weak_form or output_error");
  command->add_flag("--keep-all", arguments->options.keep_all, "Also use logs that disagree with the others");
  command
      ->add_option("--threads", arguments->options.threads,
                   "Threads; 0 is one a core. The result does not depend on it")
      ->check(CLI::NonNegativeNumber);
  command->footer(
      "Exit status 0: identified, 1: the logs are not what this robot needs for its motion (unexplained).\n"
      "Example: faultline identify healthy1.csv healthy2.csv --robot robot.toml -o identified.toml");
  command->callback([arguments, &program] {
    program.run = [arguments, &program] { return run_identify(*arguments, program.color); };
  });
}

}  // namespace faultline
