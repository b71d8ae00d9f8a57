// SPDX-License-Identifier: MIT
#include "apps/golden/golden.hpp"

#include <CLI/CLI.hpp>

#include "apps/exit_status.hpp"

namespace faultline {

int golden_status(const GoldenCheck& check) {
  if (check.damaged()) return kFileError;
  return check.same() ? kNothingFound : kFindings;
}

void add_golden_model(CLI::App& command, GoldenArguments& arguments, const char* what) {
  CLI::Option* model = add_model_option(command, arguments, what);
  add_cases_option(command, arguments, "Its case base")->needs(model);
}

void add_golden_json(CLI::App& command, GoldenArguments& arguments) {
  add_file_option(command, "--json", arguments.json,
                  "Write the differences and all compared results as JSON");
}

void add_golden_threads(CLI::App& command, GoldenArguments& arguments) {
  add_threads_option(command, arguments.threads);
}

void add_golden(CLI::App& app, Program& program) {
  CLI::App* golden = app.add_subcommand(
      "golden", "Golden logs: record the expected results for logs, and check them again later");
  golden->fallthrough();
  golden->require_subcommand(1);
  add_golden_record(golden, program);
  add_golden_check(golden, program);
  add_golden_accept(golden, program);
  add_golden_compare(golden, program);
  golden->footer(
      "Exit status 0: as expected, 1: something differs, 2: usage, 3: a golden file is damaged.\n"
      "Example: faultline golden record runs/*.csv --model robot.model -o golden");
}

}  // namespace faultline
