// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>

#include "apps/golden/golden.hpp"
#include "apps/progress.hpp"
#include "apps/work/file_use.hpp"
#include "lib/cases/case_file.hpp"
#include "lib/core/atomic_file.hpp"
#include "lib/golden/check_text.hpp"
#include "lib/golden/golden_folder.hpp"
#include "lib/golden/run_json.hpp"

namespace faultline {
namespace {

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

int run_compare(const GoldenCompareArguments& arguments, ColorChoice color) {
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

}  // namespace

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
  add_golden_threads(*command, *arguments);
  command->footer(
      "Exit status 0: both agree within the folder's tolerances, 1: they differ.\n"
      "Example: faultline golden compare golden old.model new.model\n"
      "         old/faultline golden check golden --json old.json; faultline golden compare golden "
      "old.json");
  command->callback([arguments, &program] {
    program.run = [arguments, &program] { return run_compare(*arguments, program.color); };
  });
}

}  // namespace faultline
