// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "apps/commands.hpp"
#include "apps/options.hpp"
#include "apps/terminal.hpp"
#include "apps/work/file_use.hpp"
#include "apps/work/golden_work.hpp"
#include "lib/cases/case_file.hpp"
#include "lib/core/atomic_file.hpp"
#include "lib/core/text.hpp"
#include "lib/golden/check.hpp"
#include "lib/golden/golden_folder.hpp"

namespace faultline {
namespace {

/// Returns 0 when all results are as expected, 1 for a difference, 3 for damage.
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

std::string recorded_text(const Recorded& recorded, const std::string& folder) {
  std::string text;
  for (const GoldenLog& log : recorded.set.logs)
    text += fmt::format("{}: {}, {}\n", printable(log.name()), log.expected.verdict,
                        counted(std::ssize(log.expected.events), "event"));
  if (recorded.set.identification)
    text += fmt::format("identification: {}, {} parameters from {} healthy logs\n",
                        recorded.set.identification->expected.status,
                        recorded.set.identification->expected.parameters.size(),
                        recorded.set.identification->logs.size());
  else
    text += "identification: none, " + printable(recorded.no_identification) + "\n";
  return text + fmt::format("Recorded {}. Look at {}, then commit the folder.\n",
                            counted(std::ssize(recorded.set.logs), "log"), printable(golden_file(folder)));
}

int run_record(RecordArguments arguments, ColorChoice color) {
  for (const std::string& table : skip_label_tables(arguments.logs))
    print(printable(table) + " is a table of labels, not a log; it is skipped.\n");
  ProgressBar bar(color);
  print(recorded_text(record_folder(arguments, bar.callback()), arguments.folder));
  return kNothingFound;
}

void add_golden_record(CLI::App* golden, Program& program) {
  auto arguments = std::make_shared<RecordArguments>();
  CLI::App* command =
      golden->add_subcommand("record", "Make a golden folder: logs, model and their current results");
  command->fallthrough();
  command->add_option("LOG", arguments->logs, "Small logs, healthy ones and ones with faults")->required();
  add_golden_model(*command, *arguments, "Model made by faultline learn");
  command->get_option("--model")->required();
  command->add_option("-o,--output", arguments->folder, "The folder to make")->required()->type_name("DIR");
  command->add_flag_callback(
      "--no-identification", [arguments] { arguments->options.identify = false; },
      "Do not identify the robot from the healthy logs");
  command
      ->add_option("--trace-points", arguments->options.trace_points,
                   "Largest number of points of the predicted motion to keep per log")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  add_threads_option(*command, arguments->options.threads);
  command->footer("Example: faultline golden record runs/*.csv --model robot.model -o golden");
  set_work(*command, program, [arguments](ColorChoice color) { return run_record(*arguments, color); });
}

int run_check(const GoldenArguments& arguments, ColorChoice color) {
  const GoldenCheck check = [&] {
    ProgressBar bar(color);
    return check_folder(arguments, bar.callback()).check;
  }();
  const bool in_color = use_color(color, stdout);
  if (arguments.json != "-" && arguments.junit != "-") print(render_check_text(check, in_color), in_color);
  return golden_status(check);
}

void add_golden_check(CLI::App* golden, Program& program) {
  auto arguments = std::make_shared<GoldenArguments>();
  CLI::App* command = golden->add_subcommand("check", "Replay all golden logs and compare; changes nothing");
  command->fallthrough();
  command->add_option("DIR", arguments->folder, "The golden folder")->required();
  add_golden_model(*command, *arguments, "Replay with this model instead of the folder's");
  add_golden_json(*command, *arguments);
  add_file_option(*command, "--junit", arguments->junit, "Write JUnit XML for a CI server");
  add_threads_option(*command, arguments->threads);
  command->footer(
      "Exit status 0: as expected, 1: something differs, 3: a golden file is damaged.\n"
      "Example: faultline golden check golden --junit golden.xml");
  set_work(*command, program, [arguments](ColorChoice color) { return run_check(*arguments, color); });
}

std::string sentence(const char* what, const std::vector<std::string>& names) {
  return fmt::format("{}: {}\n", what, printable(fmt::format("{}", fmt::join(names, ", "))));
}

int run_accept(const AcceptArguments& arguments, ColorChoice color) {
  const AcceptPlan plan = [&] {
    ProgressBar bar(color);
    return plan_accept(arguments, bar.callback());
  }();
  const bool in_color = use_color(color, stdout);
  print(render_check_text(arguments.same_verdict ? plan.check : plan.part, in_color), in_color);
  if (!arguments.accepts()) {
    print(plan.part.same() ? "There is nothing to accept.\n"
                           : "Nothing was changed. Name the logs to accept, or give --all.\n");
    return plan.part.same() ? kNothingFound : kFindings;
  }
  if (plan.is_refused(arguments)) {
    print(sentence("Nothing was changed. This model changes the findings in", plan.otherwise));
    return kFindings;
  }
  if (!plan.otherwise.empty()) print(sentence("Not accepted, as the findings differ in", plan.otherwise));
  carry_out(plan, arguments);
  print(plan.names.empty()
            ? "There is nothing to accept.\n"
            : sentence(arguments.has_new_model() ? "Accepted, with the new model" : "Accepted", plan.names));
  return plan.otherwise.empty() ? kNothingFound : kFindings;
}

void add_golden_accept(CLI::App* golden, Program& program) {
  auto arguments = std::make_shared<AcceptArguments>();
  CLI::App* command = golden->add_subcommand(
      "accept", "Show what differs, and make it the expected result of the named logs");
  command->fallthrough();
  command->add_option("DIR", arguments->folder, "The golden folder")->required();
  CLI::Option* names =
      command->add_option("NAME", arguments->names, "Logs to accept, or identification; none: only show");
  CLI::Option* all =
      command->add_flag("--all", arguments->all, "Accept everything that differs")->excludes(names);
  command
      ->add_flag("--same-verdict", arguments->same_verdict,
                 "Accept differences in numbers and reasons only, not in what is found")
      ->excludes(names)
      ->excludes(all);
  add_golden_model(*command, *arguments,
                   "Put this model into the folder; the expected results of logs that are not named stay");
  add_threads_option(*command, arguments->threads);
  command->footer(
      "Exit status 0: accepted or nothing to accept, 1: some differences were not accepted.\n"
      "Example: faultline golden accept golden locked_1.csv identification");
  set_work(*command, program, [arguments](ColorChoice color) { return run_accept(*arguments, color); });
}

struct GoldenCompareArguments : GoldenArguments {
  std::vector<std::string> sides;
};

/// True for the output of faultline golden check --json, which has its schema near the start, unlike a model.
bool is_result(const std::string& text) {
  return text.substr(0, 200).find("\"faultline/golden-check/") != std::string::npos;
}

/// Replays with the folder's own model.
GoldenRun own_side(const GoldenCompareArguments& arguments, const GoldenSet& set, ColorChoice color) {
  ProgressBar bar(color);
  return golden_run(arguments, set, load_golden_model(arguments.folder, set), bar.callback());
}

GoldenRun side(const std::string& path, const GoldenCompareArguments& arguments, const GoldenSet& set,
               ColorChoice color) {
  ProgressBar bar(color);
  if (const std::string text = read_file(path); is_result(text)) return run_from_json(text, path);
  return golden_run(arguments, set, load_model_and_cases(path, case_base_path(path)), bar.callback());
}

int run_golden_compare(const GoldenCompareArguments& arguments, ColorChoice color) {
  const GoldenSet set = load_golden(arguments.folder);
  FileUse files;
  reads_golden(files, arguments, set);
  for (const std::string& path : arguments.sides) files.reads(ModelPaths{path, ""});
  files.writes("--json", arguments.json).claim();
  const GoldenRun first = side(arguments.sides[0], arguments, set, color);
  const GoldenRun second = arguments.sides.size() > 1 ? side(arguments.sides[1], arguments, set, color)
                                                      : own_side(arguments, set, color);
  const GoldenCheck check = compare_runs(set, first, second);
  if (!arguments.json.empty()) write_file(arguments.json, render_check_json(check, second));
  const bool in_color = use_color(color, stdout);
  if (arguments.json != "-") print(render_check_text(check, in_color), in_color);
  return golden_status(check);
}

void add_golden_compare(CLI::App* golden, Program& program) {
  auto arguments = std::make_shared<GoldenCompareArguments>();
  CLI::App* command =
      golden->add_subcommand("compare", "Compare two models, or two program versions, on one golden folder");
  command->fallthrough();
  command->add_option("DIR", arguments->folder, "The golden folder")->required();
  command
      ->add_option("SIDE", arguments->sides,
                   "A model (with " + case_base_path("MODEL") +
                       " beside it), or the output of golden check --json of any version of the program; a "
                       "single one is compared with the folder's model and this program")
      ->required()
      ->expected(1, 2);
  add_golden_json(*command, *arguments);
  add_threads_option(*command, arguments->threads);
  command->footer(
      "Exit status 0: both agree within the folder's tolerances, 1: they differ.\n"
      "Example: faultline golden compare golden old.model new.model\n"
      "         old/faultline golden check golden --json old.json; faultline golden compare golden "
      "old.json");
  set_work(*command, program,
           [arguments](ColorChoice color) { return run_golden_compare(*arguments, color); });
}

}  // namespace

void add_golden(CLI::App& app, Program& program) {
  CLI::App* golden = app.add_subcommand(
      "golden", "Golden logs: record the expected results for logs, and check them again later");
  golden->fallthrough();
  golden->require_subcommand(1);
  add_golden_record(golden, program);
  add_golden_check(golden, program);
  add_golden_accept(golden, program);
  add_golden_compare(golden, program);
  add_golden_run(*golden, program);
  golden->footer(
      "Exit status 0: as expected, 1: something differs, 2: usage, 3: a golden file is damaged.\n"
      "Example: faultline golden record runs/*.csv --model robot.model -o golden");
}

}  // namespace faultline
