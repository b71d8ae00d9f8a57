// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "apps/commands.hpp"
#include "apps/terminal.hpp"
#include "apps/work/simulation.hpp"

namespace faultline {
namespace {

struct SimulateArguments : SimulateRequest {
  bool json = false;
};

std::string text_line(const nlohmann::ordered_json& run) {
  std::string line = fmt::format("{:<32} {:>8} rows", run["file"].get<std::string>(), run["rows"].get<int>());
  for (const auto& fault : run["faults"])
    line += fmt::format("  {} joint {} at {} s", fault["kind"].get<std::string>(), fault["joint"].get<int>(),
                        fault["onset_s"].get<double>());
  const std::string end = run["end_reason"];
  return line + (end == "complete" ? "" : "  " + end) + "\n";
}

int simulate_file(const SimulateArguments& arguments, ColorChoice color) {
  nlohmann::ordered_json made;
  {
    ProgressBar bar(color);
    made = simulate_into(arguments, bar.callback());
  }
  if (arguments.json) {
    print(made.dump(2) + "\n");
    return kNothingFound;
  }
  std::string text;
  for (const auto& run : made["runs"]) text += text_line(run);
  print(text);
  return kNothingFound;
}

}  // namespace

void add_simulate(CLI::App& app, Program& program) {
  auto arguments = std::make_shared<SimulateArguments>();
  CLI::App* command = app.add_subcommand("simulate", "Simulate runs of a robot, healthy or with faults");
  command->add_option("SPEC", arguments->spec, "Spec file (TOML): the robot and its runs")->required();
  command->add_option("-o,--output", arguments->folder, "Folder for the logs and labels.csv")
      ->required()
      ->type_name("DIR");
  command->add_option("--seed", arguments->seed, "Seed, instead of the one in the spec")->type_name("N");
  command->add_flag("--json", arguments->json, "Print the simulated runs as JSON");
  command->footer("Example: faultline simulate sample_logs/bench/spec.toml -o /tmp/bench");
  set_work(*command, program, [arguments](ColorChoice color) { return simulate_file(*arguments, color); });
}

}  // namespace faultline
