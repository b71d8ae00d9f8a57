// SPDX-License-Identifier: MIT
#include "apps/golden/golden.hpp"

#include <CLI/CLI.hpp>

#include "apps/exit_status.hpp"
#include "apps/file_use.hpp"
#include "apps/progress.hpp"
#include "apps/robot_log.hpp"
#include "lib/golden/golden_folder.hpp"

namespace faultline {

std::unique_ptr<LogSource> open_golden_log(const std::string& path, const Model& model) {
  return open_robot_log(path, model.robot);
}

ModelAndCases golden_subject(const GoldenArguments& arguments, const GoldenSet& set) {
  return arguments.model.empty() ? load_golden_model(arguments.folder, set)
                                 : load_model_and_cases(arguments.model, arguments.case_base());
}

GoldenRun golden_run(const GoldenArguments& arguments, const GoldenSet& set, const ModelAndCases& subject,
                     ColorChoice color) {
  ProgressBar bar(color);
  return replay(replay_logs(arguments.folder, set), subject, open_golden_log,
                {set.trace_points, arguments.threads}, bar.callback());
}

void reads_golden(FileUse& files, const GoldenArguments& arguments, const GoldenSet& set) {
  const std::string what = "the golden folder's", folder = arguments.folder + "/";
  files.reads(what, golden_file(arguments.folder));
  for (const GoldenLog& log : set.logs)
    files.reads(what, folder + log.log.path).reads(what, folder + log.trace.path);
  files.reads(ModelPaths{folder + set.model.path, folder + set.cases.path}).reads(arguments);
}

int golden_status(const GoldenCheck& check) {
  if (check.damaged()) return kFileError;
  return check.same() ? kNothingFound : kFindings;
}

void add_golden_model(CLI::App& command, GoldenArguments& arguments, const char* what) {
  CLI::Option* model = add_model_option(command, arguments, what);
  add_cases_option(command, arguments, "Its case base")->needs(model);
}

void add_golden_json(CLI::App& command, GoldenArguments& arguments) {
  add_file_option(command, "--json", arguments.json, "Write differences and all that was compared as JSON");
}

void add_golden_threads(CLI::App& command, GoldenArguments& arguments) {
  add_threads_option(command, arguments.threads);
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
