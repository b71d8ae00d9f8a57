// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "apps/commands.hpp"
#include "apps/options.hpp"
#include "apps/work/golden_work.hpp"
#include "lib/core/atomic_file.hpp"
#include "lib/golden/new_run.hpp"

namespace faultline {
namespace {

int run_golden_run(const NewRunArguments& arguments) {
  const std::vector<NewRunCheck> runs = check_new_runs(arguments);
  if (!arguments.json.empty()) write_file(arguments.json, new_runs_json(runs));
  if (!arguments.junit.empty()) write_file(arguments.junit, new_runs_junit(runs));
  if (arguments.json != "-" && arguments.junit != "-") print(to_text(runs));
  const bool same = std::all_of(runs.begin(), runs.end(), [](const NewRunCheck& run) { return run.same(); });
  return same ? kNothingFound : kFindings;
}

}  // namespace

void add_golden_run(CLI::App& golden, Program& program) {
  auto arguments = std::make_shared<NewRunArguments>();
  CLI::App* command = golden.add_subcommand(
      "run", "Hold new runs of a controller against the recorded healthy runs of the same motion");
  command->fallthrough();
  command->add_option("NEW", arguments->logs, "Logs of new runs")->required();
  command->add_option("--against", arguments->folder, "The golden folder")->required()->type_name("GOLD");
  add_file_option(*command, "--json", arguments->json, "Write all compared signals as JSON");
  add_file_option(*command, "--junit", arguments->junit,
                  "Write JUnit XML with a case for each run and signal");
  command->footer(
      "Runs are aligned by their motion. A tolerance is the spread of the recorded healthy runs;\n"
      "runs.toml of the folder makes it wider, with a reason.\n"
      "Exit status 0: as recorded, 1: a run differs, or its motion is not recorded.\n"
      "Example: faultline golden run new/*.csv --against golden --junit runs.xml");
  command->callback(
      [arguments, &program] { program.run = [arguments] { return run_golden_run(*arguments); }; });
}

}  // namespace faultline
