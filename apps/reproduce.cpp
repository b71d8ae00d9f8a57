// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "apps/commands.hpp"
#include "apps/options.hpp"
#include "apps/terminal.hpp"
#include "apps/work/simulation.hpp"
#include "lib/reproduce/page/result_table.hpp"

namespace faultline {
namespace {

struct ReproduceArguments {
  std::string folder = "reproduction";
  bool json = false;
  ReproduceOptions options;
};

std::string goal_line(const Goal& goal) {
  return fmt::format("  {:<3}  {} {} (to reach: {} {} {})\n       {}\n", goal.reached() ? "yes" : "NO",
                     figure_text(goal.measured, goal.style), goal.unit, goal.at_most ? "at most" : "at least",
                     figure_text(goal.bound, goal.style), goal.unit, goal.what);
}

std::string summary(const Reproduction& reproduction, const std::string& folder) {
  std::string lines;
  int reached = 0;
  for (const Goal& goal : reproduction.goals) {
    reached += goal.reached() ? 1 : 0;
    lines += goal_line(goal);
  }
  return fmt::format(
      "{} tables and {} pictures. {} of {} goals reached:\n"
      "{}\n"
      "Read {}/index.md; all numbers are in index.json.\n",
      reproduction.tables.size(), reproduction.figures.size(), reached, reproduction.goals.size(), lines,
      folder);
}

int run_reproduce(const ReproduceArguments& arguments, ColorChoice color) {
  const ReproducedFolder made = [&] {
    ProgressBar bar(color);
    return reproduce_into(arguments.folder, arguments.options, bar.callback());
  }();
  print(arguments.json ? made.json : summary(made.reproduction, arguments.folder));
  return kNothingFound;
}

}  // namespace

void add_reproduce(CLI::App& app, Program& program) {
  auto arguments = std::make_shared<ReproduceArguments>();
  ReproduceOptions& options = arguments->options;
  CLI::App* command =
      app.add_subcommand("reproduce", "Rebuild the tables and figures of the paper behind the method");
  command->add_option("-o,--output", arguments->folder, "Folder for index.md, index.json and the pictures")
      ->type_name("DIR")
      ->capture_default_str();
  command->add_flag("--quick", options.quick, "Run one experiment, for orders of magnitude within a minute");
  auto* seeds =
      command->add_option("--seeds", options.seeds, "Number of experiments; results are their means")
          ->type_name("N")
          ->capture_default_str();
  command->add_option("--seed", options.seed, "Seed of the first experiment")
      ->type_name("N")
      ->capture_default_str();
  add_threads_option(*command, options.threads)->type_name("N");
  command->add_flag("--json", arguments->json, "Print index.json instead of a summary");
  command->footer(
      "The full run takes about fifteen minutes on two cores.\n"
      "Example: faultline reproduce --quick -o /tmp/paper");
  command->callback([arguments, seeds, &program] {
    if (arguments->options.quick && seeds->count() == 0) arguments->options.seeds = 1;
    program.run = [arguments, &program] { return run_reproduce(*arguments, program.color); };
  });
}

}  // namespace faultline
