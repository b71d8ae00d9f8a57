// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>

#include "apps/golden/golden.hpp"
#include "apps/progress.hpp"
#include "lib/golden/check_text.hpp"

namespace faultline {
namespace {

int run_check(const GoldenArguments& arguments, ColorChoice color) {
  const GoldenCheck check = [&] {
    ProgressBar bar(color);
    return check_folder(arguments, bar.callback()).check;
  }();
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
