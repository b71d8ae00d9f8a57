// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <memory>

#include "apps/commands.hpp"
#include "apps/options.hpp"
#include "apps/work/comparison.hpp"
#include "apps/work/file_use.hpp"
#include "apps/work/robot_log.hpp"
#include "formats/open_log.hpp"
#include "lib/core/atomic_file.hpp"
#include "lib/log/derived_velocity.hpp"
#include "lib/model/model.hpp"
#include "lib/report/comparison_junit.hpp"
#include "lib/report/html/comparison/comparison_page.hpp"

namespace faultline {
namespace {

struct CompareArguments {
  std::string first, second, model, html, json, junit;
  AlignmentKind align = AlignmentKind::automatic;
};

void claim_files(const CompareArguments& arguments) {
  FileUse()
      .reads("the first log", arguments.first)
      .reads("the second log", arguments.second)
      .reads(ModelPaths{arguments.model, ""})
      .writes("--html", arguments.html)
      .writes("--json", arguments.json)
      .writes("--junit", arguments.junit)
      .claim();
}

std::unique_ptr<LogSource> opened(const std::string& path, const Model* model) {
  return with_velocity(model ? open_robot_log(path, model->robot) : open_log(path));
}

int run_compare(const CompareArguments& arguments) {
  claim_files(arguments);
  std::unique_ptr<Model> model;
  if (!arguments.model.empty()) model = std::make_unique<Model>(load_model(arguments.model));
  const auto first = opened(arguments.first, model.get()), second = opened(arguments.second, model.get());
  const auto [comparison, turns] = compare_logs(*first, *second, model.get(), arguments.align);
  if (!arguments.json.empty()) write_file(arguments.json, to_json(comparison, turns));
  if (!arguments.html.empty()) write_file(arguments.html, render_comparison_html(comparison, turns));
  if (!arguments.junit.empty()) write_file(arguments.junit, comparison_junit(comparison, turns));
  if (arguments.json != "-" && arguments.html != "-" && arguments.junit != "-")
    print(to_text(comparison, turns));
  return comparison.same() ? kNothingFound : kFindings;
}

}  // namespace

void add_compare(CLI::App& app, Program& program) {
  auto arguments = std::make_shared<CompareArguments>();
  CLI::App* command =
      app.add_subcommand("compare", "Compare two runs signal by signal: where they differ, and by how much");
  command->add_option("FIRST", arguments->first, "A log, such as a good run")->required();
  command->add_option("SECOND", arguments->second, "Another log of the same robot")->required();
  command
      ->add_option("--model", arguments->model,
                   "Model of the robot, for its columns and units and for residuals of both runs")
      ->type_name("MODEL");
  add_choice_option(
      *command, "--align", arguments->align, kAlignmentKinds,
      "time: each from its first row; motion: by the references, a constant shift or a warp; auto: "
      "motion if that is better")
      ->default_str(to_string(arguments->align));
  add_file_option(*command, "--html", arguments->html, "Write a page with plots");
  add_file_option(*command, "--json", arguments->json, "Write the comparison as JSON");
  add_file_option(*command, "--junit", arguments->junit, "Write JUnit XML with a case for each signal");
  command->footer(
      "Exit status 0: the same within noise, 1: the runs differ.\n"
      "Example: faultline compare good.csv bad.csv --model robot.model --html compare.html");
  command->callback([arguments, &program] { program.run = [arguments] { return run_compare(*arguments); }; });
}

}  // namespace faultline
