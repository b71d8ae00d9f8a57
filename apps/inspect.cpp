// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "apps/commands.hpp"
#include "apps/exit_status.hpp"
#include "lib/core/hash.hpp"

namespace faultline {
namespace {

struct InspectArguments {
  std::vector<std::string> logs;
};

int inspect(const InspectArguments& arguments) {
  for (const std::string& log : arguments.logs) print(log + "  sha256 " + sha256_of_file(log) + "\n");
  return kNothingFound;
}

}  // namespace

void add_inspect(CLI::App& app, Program& program) {
  auto arguments = std::make_shared<InspectArguments>();
  CLI::App* command = app.add_subcommand("inspect", "Tell what is in logs and what is wrong with them");
  command->add_option("LOG", arguments->logs, "Log files")->required();
  command->footer("Example: faultline inspect run.csv");
  command->callback([arguments, &program] { program.run = [arguments] { return inspect(*arguments); }; });
}

}  // namespace faultline
