// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "apps/commands.hpp"
#include "apps/exit_status.hpp"
#include "apps/file_use.hpp"
#include "apps/folder.hpp"
#include "apps/progress.hpp"
#include "formats/write_log.hpp"
#include "lib/core/atomic_file.hpp"
#include "lib/log/transformed/coupled_source.hpp"
#include "lib/simulate/run_labels.hpp"
#include "lib/simulate/spec_file.hpp"

namespace faultline {
namespace {

struct SimulateArguments {
  std::string spec;
  std::string folder;
  std::optional<std::uint64_t> seed;
  bool json = false;
};

nlohmann::ordered_json summary(const SimulationFile& file, const RunSpec& spec, const SimulatedRun& run) {
  nlohmann::ordered_json faults = nlohmann::ordered_json::array();
  for (const SimulatedFault& fault : run.truth)
    faults.push_back({{"kind", to_string(fault.kind)},
                      {"joint", fault.joint},
                      {"onset_s", fault.onset_s},
                      {"end_s", fault.end_s},
                      {"size", fault.size}});
  return {{"file", spec.name + "." + file.format},
          {"seed", spec.seed},
          {"rows", run.log.rows()},
          {"end_reason", to_string(run.end)},
          {"faults", faults}};
}

std::string text_line(const nlohmann::ordered_json& run) {
  std::string line = fmt::format("{:<32} {:>8} rows", run["file"].get<std::string>(), run["rows"].get<int>());
  for (const auto& fault : run["faults"])
    line += fmt::format("  {} joint {} at {} s", fault["kind"].get<std::string>(), fault["joint"].get<int>(),
                        fault["onset_s"].get<double>());
  const std::string end = run["end_reason"];
  return line + (end == "complete" ? "" : "  " + end) + "\n";
}

std::string log_path(const SimulateArguments& arguments, const SimulationFile& file, const RunSpec& run) {
  return (std::filesystem::path(arguments.folder) / (run.name + "." + file.format)).string();
}

std::string labels_path(const SimulateArguments& arguments) {
  return (std::filesystem::path(arguments.folder) / "labels.csv").string();
}

void claim_files(const SimulateArguments& arguments, const SimulationFile& file) {
  FileUse files;
  files.reads("the spec", arguments.spec).reads("the robot file", file.robot_path);
  for (const RunSpec& run : file.runs)
    files.writes("the run " + run.name + ",", log_path(arguments, file, run));
  files.writes("the labels,", labels_path(arguments)).claim();
}

int simulate_file(const SimulateArguments& arguments, ColorChoice color) {
  const SimulationFile file =
      load_simulation_file(arguments.spec, {arguments.seed.has_value(), arguments.seed.value_or(1)});
  claim_files(arguments, file);
  make_folder(arguments.folder);
  nlohmann::ordered_json runs = nlohmann::ordered_json::array();
  std::string labels = labels_header();
  {
    ProgressBar bar(color);
    const Progress progress = bar.callback();
    for (std::size_t i = 0; i < file.runs.size(); ++i) {
      const RunSpec& spec = file.runs[i];
      if (progress)
        progress("simulate " + spec.name, static_cast<double>(i) / static_cast<double>(file.runs.size()));
      const SimulatedRun run = simulate(file.robot, spec.simulation, spec.seed);
      write_log(log_path(arguments, file, spec), uncoupled(run.log, file.robot.log.coupling));
      labels += label_lines(file, spec, run);
      runs.push_back(summary(file, spec, run));
    }
  }
  write_file(labels_path(arguments), labels);
  if (arguments.json) {
    print(nlohmann::ordered_json{
              {"schema", "faultline/simulation/1"}, {"robot", file.robot.name}, {"runs", runs}}
              .dump(2) +
          "\n");
    return kNothingFound;
  }
  std::string text;
  for (const auto& run : runs) text += text_line(run);
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
  command->add_option("--seed", arguments->seed, "Seed in place of the spec's")->type_name("N");
  command->add_flag("--json", arguments->json, "Tell what was made as JSON");
  command->footer("Example: faultline simulate sample_logs/bench/spec.toml -o /tmp/bench");
  command->callback([arguments, &program] {
    program.run = [arguments, &program] { return simulate_file(*arguments, program.color); };
  });
}

}  // namespace faultline
