// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "apps/commands.hpp"
#include "apps/options.hpp"
#include "apps/work/file_use.hpp"
#include "apps/work/history_results.hpp"
#include "lib/core/atomic_file.hpp"
#include "lib/history/history_file.hpp"
#include "lib/history/robot_history.hpp"

namespace faultline {
namespace {

struct HistoryArguments {
  std::vector<std::string> results, robots;
  std::string db, page, json;
};

void claim_files(const HistoryArguments& arguments) {
  FileUse files;
  for (const std::string& path : arguments.results) {
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored))
      files.reads_below("the results", path + "/logs");
    else
      files.reads("the result", path);
  }
  files.writes_case_base("--db", arguments.db)
      .writes("-o", arguments.page)
      .writes("--json", arguments.json)
      .claim();
}

int run_history(const HistoryArguments& arguments) {
  claim_files(arguments);
  if (!arguments.results.empty()) {
    const HistoryGrowth growth = add_to_history(arguments.db, history_results(arguments.results));
    print_message(fmt::format("{} added, {} replaced, {} known before", growth.added, growth.replaced,
                              growth.unchanged));
  }
  const auto robots = robot_histories(read_history(arguments.db), arguments.robots);
  if (!arguments.page.empty()) write_file(arguments.page, history_page(robots));
  if (!arguments.json.empty()) write_file(arguments.json, history_json(robots));
  if (arguments.page != "-" && arguments.json != "-") print(to_text(robots));
  return kNothingFound;
}

}  // namespace

void add_history(CLI::App& app, Program& program) {
  auto arguments = std::make_shared<HistoryArguments>();
  CLI::App* command = app.add_subcommand(
      "history", "Keep the results of many batches, and show how the condition of each robot changes");
  command->add_option("RESULTS", arguments->results,
                      "Folders of faultline batch, or files of faultline diagnose --json, to add");
  command->add_option("--db", arguments->db, "The history: one file that grows")
      ->type_name("HISTORY.sqlite")
      ->required();
  add_file_option(*command, "-o,--output", arguments->page, "Write a page with a line a robot");
  add_file_option(*command, "--json", arguments->json, "Write the same as JSON");
  command
      ->add_option("--robot", arguments->robots,
                   "Show only the robot of this name (may be given several times)")
      ->type_name("NAME")
      ->allow_extra_args(false);
  command->footer(
      "A result that is known is not added again. Without RESULTS the history is only shown.\n"
      "Example: faultline history out/march out/april --db robots.sqlite -o robots.html");
  command->callback([arguments, &program] { program.run = [arguments] { return run_history(*arguments); }; });
}

}  // namespace faultline
