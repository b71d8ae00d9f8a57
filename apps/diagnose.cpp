// SPDX-License-Identifier: MIT
#include "lib/pipeline/diagnose.hpp"

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/commands.hpp"
#include "apps/exit_status.hpp"
#include "formats/open_log.hpp"
#include "lib/cases/case_file.hpp"
#include "lib/core/atomic_file.hpp"
#include "lib/html/html_report.hpp"
#include "lib/html/report_details.hpp"
#include "lib/log/prefetch.hpp"
#include "lib/report/csv.hpp"
#include "lib/report/json.hpp"
#include "lib/report/junit.hpp"
#include "lib/report/markdown.hpp"
#include "lib/report/text.hpp"

namespace faultline {
namespace {

struct DiagnoseArguments {
  std::string log, model, cases, json, csv, html, md, junit;
  std::string mode = "evidence", criterion = "log_odds";
  int g = 0;

  bool standard_output_is_taken() const {
    return json == "-" || csv == "-" || html == "-" || md == "-" || junit == "-";
  }
};

void write_reports(const Diagnosis& diagnosis, const DiagnoseArguments& arguments) {
  if (!arguments.json.empty()) write_file(arguments.json, render_json(diagnosis));
  if (!arguments.csv.empty()) write_file(arguments.csv, render_csv(diagnosis));
  if (!arguments.md.empty()) write_file(arguments.md, render_markdown(diagnosis));
  if (!arguments.junit.empty()) write_file(arguments.junit, render_junit(diagnosis));
}

DiagnoseOptions diagnose_options(const DiagnoseArguments& arguments) {
  DiagnoseOptions options;
  options.mode = arguments.mode == "samples" ? ClassifyMode::samples : ClassifyMode::evidence;
  options.criterion =
      arguments.criterion == "consecutive" ? CriterionKind::consecutive : CriterionKind::log_odds;
  options.g = arguments.g;
  return options;
}

int run_diagnose(const DiagnoseArguments& arguments, ColorChoice color) {
  const Model model = load_model(arguments.model);
  const CaseBase cases = read_case_base(arguments.cases);
  OpenLogOptions options;
  options.columns = model.robot.log.columns;
  options.keep_extra = false;
  const auto log = prefetched(open_log(arguments.log, options));
  const DiagnoseOptions how = diagnose_options(arguments);
  const Diagnosis diagnosis = diagnose(*log, model, cases, how);
  write_reports(diagnosis, arguments);
  if (!arguments.html.empty())
    write_file(arguments.html, render_html(diagnosis, report_details(*log, model, diagnosis, how)));
  TimelineOptions timeline;
  timeline.color = use_color(color, stdout);
  if (!arguments.standard_output_is_taken()) print(render_text(diagnosis, timeline));
  return diagnosis.verdict == Verdict::faulty ? kFindings : kNothingFound;
}

}  // namespace

void add_diagnose(CLI::App& app, Program& program) {
  auto arguments = std::make_shared<DiagnoseArguments>();
  CLI::App* command = app.add_subcommand("diagnose", "Find the faults in one log: kind, joint and time");
  command->add_option("LOG", arguments->log, "The log of the run")->required();
  command->add_option("--model", arguments->model, "Model made by faultline learn")
      ->required()
      ->type_name("MODEL");
  command->add_option("--cases", arguments->cases, "Case base, MODEL.cases.db by default")->type_name("FILE");
  auto report = [&](const char* flag, std::string& path, const char* what) {
    command->add_option(flag, path, std::string(what) + "; - for standard output")->type_name("F");
  };
  report("--json", arguments->json, "Write the diagnosis as JSON");
  report("--csv", arguments->csv, "Write one row a fault as CSV");
  report("--html", arguments->html, "Write a page to look at: plots, evidence, similar cases, provenance");
  report("--md", arguments->md, "Write Markdown for an issue tracker");
  report("--junit", arguments->junit, "Write JUnit XML for a CI server");
  command
      ->add_option("--classify", arguments->mode,
                   "evidence: hypotheses on the identified robot, judged by both networks; samples: the "
                   "paper's way, both networks over the residuals of each sample")
      ->check(CLI::IsMember({"evidence", "samples"}))
      ->capture_default_str();
  command
      ->add_option("--criterion", arguments->criterion,
                   "With --classify samples: sum of log odds, or g consecutive samples (the paper)")
      ->check(CLI::IsMember({"log_odds", "consecutive"}))
      ->capture_default_str();
  command->add_option("--g", arguments->g, "With --criterion consecutive: samples; 0 = as tuned by learn")
      ->check(CLI::NonNegativeNumber);
  command->footer(
      "Exit status 0: healthy or inconclusive, 1: a fault was found.\n"
      "Example: faultline diagnose run.csv --model robot.model --json report.json");
  command->callback([arguments, &program] {
    if (arguments->cases.empty()) arguments->cases = arguments->model + ".cases.db";
    program.run = [arguments, &program] { return run_diagnose(*arguments, program.color); };
  });
}

}  // namespace faultline
