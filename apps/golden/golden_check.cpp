// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <filesystem>

#include "apps/file_use.hpp"
#include "apps/golden/golden.hpp"
#include "lib/core/atomic_file.hpp"
#include "lib/golden/check_junit.hpp"
#include "lib/golden/check_text.hpp"
#include "lib/golden/golden_folder.hpp"
#include "lib/golden/run_json.hpp"

namespace faultline {
namespace {

/// The folder's own name, without what leads to it on this machine.
std::string suite_name(const std::string& folder) {
  const std::filesystem::path path = std::filesystem::weakly_canonical(folder);
  return path.has_filename() ? path.filename().string() : path.parent_path().filename().string();
}

int run_check(const GoldenArguments& arguments, ColorChoice color) {
  const GoldenSet set = load_golden(arguments.folder);
  FileUse files;
  reads_golden(files, arguments, set);
  files.writes("--json", arguments.json).writes("--junit", arguments.junit).claim();
  const ModelAndCases subject = golden_subject(arguments, set);
  const GoldenRun run = golden_run(arguments, set, subject, color);
  const GoldenCheck check = check_golden(set, run);
  if (!arguments.json.empty()) write_file(arguments.json, render_check_json(check, run));
  if (!arguments.junit.empty())
    write_file(arguments.junit, render_check_junit(check, suite_name(arguments.folder)));
  const bool in_color = use_color(color, stdout);
  if (arguments.json != "-" && arguments.junit != "-") print(render_check_text(check, in_color), in_color);
  return golden_status(check);
}

}  // namespace

void add_golden_check(CLI::App* golden, Program& program) {
  auto arguments = std::make_shared<GoldenArguments>();
  CLI::App* command = golden->add_subcommand("check", "Replay all golden logs and compare; changes nothing");
  command->fallthrough();
  command->add_option("DIR", arguments->folder, "The golden folder")->required();
  add_golden_model(*command, *arguments, "Replay with this model instead of the folder's");
  add_golden_json(*command, *arguments);
  add_file_option(*command, "--junit", arguments->junit, "Write JUnit XML for a CI server");
  add_golden_threads(*command, *arguments);
  command->footer(
      "Exit status 0: as expected, 1: something differs, 3: a golden file is damaged.\n"
      "Example: faultline golden check golden --junit golden.xml");
  command->callback([arguments, &program] {
    program.run = [arguments, &program] { return run_check(*arguments, program.color); };
  });
}

}  // namespace faultline
