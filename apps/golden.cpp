// SPDX-License-Identifier: MIT
#include "apps/golden.hpp"

#include <CLI/CLI.hpp>

#include "apps/exit_status.hpp"
#include "apps/progress.hpp"
#include "formats/open_log.hpp"
#include "lib/golden/golden_folder.hpp"

namespace faultline {

std::unique_ptr<LogSource> open_golden_log(const std::string& path, const Model& model) {
  OpenLogOptions options;
  options.columns = model.robot.log.columns;
  options.keep_extra = false;
  return open_log(path, options);
}

std::string cases_path(const GoldenArguments& arguments) {
  return arguments.cases.empty() ? arguments.model + ".cases.db" : arguments.cases;
}

ModelAndCases golden_subject(const GoldenArguments& arguments, const GoldenSet& set) {
  return arguments.model.empty() ? load_golden_model(arguments.folder, set)
                                 : load_model_and_cases(arguments.model, cases_path(arguments));
}

GoldenRun golden_run(const GoldenArguments& arguments, const GoldenSet& set, const ModelAndCases& subject,
                     ColorChoice color) {
  ProgressBar bar(color);
  return replay(replay_logs(arguments.folder, set), subject, open_golden_log,
                {set.trace_points, arguments.threads}, bar.callback());
}

int golden_status(const GoldenCheck& check) {
  if (check.damaged()) return kFileError;
  return check.same() ? kNothingFound : kFindings;
}

void add_model_options(CLI::App* command, GoldenArguments& arguments, const char* what) {
  CLI::Option* model = command->add_option("--model", arguments.model, what)->type_name("MODEL");
  command->add_option("--cases", arguments.cases, "Its case base, MODEL.cases.db by default")
      ->type_name("FILE")
      ->needs(model);
}

void add_json_option(CLI::App* command, GoldenArguments& arguments) {
  command
      ->add_option("--json", arguments.json,
                   "Write differences and all that was compared as JSON; - for standard output")
      ->type_name("F");
}

void add_threads_option(CLI::App* command, GoldenArguments& arguments) {
  command->add_option("--threads", arguments.threads, "0 = one a core; changes no byte")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
}

void add_golden(CLI::App& app, Program& program) {
  CLI::App* golden = app.add_subcommand(
      "golden", "Golden logs: record what is expected of logs, and check that it stays so");
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
