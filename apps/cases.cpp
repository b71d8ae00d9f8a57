// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <memory>

#include "apps/cases/case_actions.hpp"
#include "apps/commands.hpp"
#include "apps/options.hpp"
#include "lib/cases/case_file.hpp"

namespace faultline {
namespace {

struct CasesCommand : CasesArguments {
  bool json = false;
};
using Arguments = std::shared_ptr<CasesCommand>;
using Action = CasesAnswer (*)(const CasesArguments&);

int run_action(const CasesCommand& arguments, Action action) {
  const CasesAnswer answer = action(arguments);
  if (!answer.note.empty()) print_message(answer.note);
  if (!answer.json.is_null()) print(arguments.json ? answer.json.dump(2) + "\n" : answer.text);
  return kNothingFound;
}

CLI::App* add_action(CLI::App* cases, Program& program, const Arguments& arguments, const std::string& name,
                     const std::string& what, Action action) {
  CLI::App* command = cases->add_subcommand(name, what);
  command->fallthrough();
  command->callback([arguments, action, &program] {
    program.run = [arguments, action] { return run_action(*arguments, action); };
  });
  return command;
}

void add_label(CLI::App* command, const Arguments& arguments, const std::string& what) {
  command->add_option("--fault", arguments->fault, what)->type_name("KIND");
  command->add_option("--joint", arguments->joint_number, "Joint of that fault, from 1")
      ->check(CLI::NonNegativeNumber);
}

void add_reading_actions(CLI::App* cases, Program& program, const Arguments& arguments) {
  CLI::App* command = add_action(cases, program, arguments, "list", "List cases, one per line", list_cases);
  add_label(command, arguments, "Only cases of this fault");
  command->add_option("--outcome", arguments->outcome, "Only unconfirmed, confirmed or rejected ones");
  command->add_option("--origin", arguments->origin,
                      "Only cases of this origin: field (described by a person), labelled (logs), "
                      "diagnosed or simulated");
  command->add_option("--by", arguments->by, "Only cases described by this person")->type_name("PERSON");
  command->add_option("--robot", arguments->robot, "Only cases of this robot")->type_name("NAME");
  command->footer("Example: faultline cases list --model bench.json --outcome unconfirmed");
  command = add_action(cases, program, arguments, "show", "Show one case in full", show_case);
  command->add_option("ID", arguments->id, "Number of the case")->required();
  command->footer("Example: faultline cases show 12 --model bench.json");
  command =
      add_action(cases, program, arguments, "export", "Write all cases as JSON, without loss", export_cases);
  command->add_flag("--confirmed", arguments->confirmed,
                    "Only cases from the field that a person confirmed or corrected");
  command->add_option("-o,--output", arguments->file, "File, - for standard output (default)");
  command->footer("Example: faultline cases export --model bench.json -o cases.json");
}

void add_signature(CLI::App* command, const Arguments& arguments) {
  command->add_option("--by", arguments->by, "Person who states this")->type_name("PERSON");
  command->add_option("--date", arguments->date, "When, YYYY-MM-DD (default: today, or SOURCE_DATE_EPOCH)")
      ->type_name("DATE");
}

void add_revision(CLI::App* cases, Program& program, const Arguments& arguments, const std::string& name,
                  const std::string& what, const std::string& label, Action action) {
  CLI::App* command = add_action(cases, program, arguments, name, what, action);
  command->add_option("ID", arguments->id, "Number of the case")->required();
  add_label(command, arguments, label);
  command->add_option("--done", arguments->done, "What was done about it")->type_name("TEXT");
  add_signature(command, arguments);
  command->footer("Example: faultline cases " + name +
                  " 12 --model bench.json --done \"changed the brake relay\"");
}

void add_writing_actions(CLI::App* cases, Program& program, const Arguments& arguments) {
  CLI::App* command =
      add_action(cases, program, arguments, "add", "Add a diagnosed fault as a case", add_case);
  command->add_option("DIAGNOSIS", arguments->diagnosis, "JSON report of faultline diagnose");
  command->add_option("--fault-id", arguments->fault_id, "Number of the fault in the report (default 1)");
  add_label(command, arguments, "Actual fault; the case is then confirmed");
  command->add_option("--done", arguments->done, "What was done about it")->type_name("TEXT");
  add_signature(command, arguments);
  command
      ->add_option("--robot", arguments->robot, "The robot that had the fault (default: that of the report)")
      ->type_name("NAME");
  command->footer(
      "An event that is already a case is not added again; new statements about it are kept.\n"
      "Example: faultline cases add report.json --fault locked --joint 2 --by Weber --model bench.json");
  add_revision(cases, program, arguments, "confirm", "Confirm that the decision of a case was right",
               "Actual fault, if it differs from the decision", confirm_case);
  add_revision(cases, program, arguments, "reject", "Record that the decision of a case was wrong",
               "Actual fault, if known", reject_case);
  command = add_action(cases, program, arguments, "delete", "Remove a case for good", delete_case);
  command->add_option("ID", arguments->id, "Number of the case")->required();
  command->footer("Example: faultline cases delete 12 --model bench.json");
  command = add_action(cases, program, arguments, "import", "Make a case base from an export", import_cases);
  command->add_option("FILE", arguments->file, "File written by export, - for standard input")->required();
  CLI::Option* merge = command->add_flag("--merge", arguments->merge,
                                         "Add the new cases to a case base of the same kind of robot");
  command->add_flag("--replace", arguments->replace, "Replace an existing case base")->excludes(merge);
  command->footer("Example: faultline cases import cases.json --cases " + case_base_path("bench.json"));
}

}  // namespace

void add_cases(CLI::App& app, Program& program) {
  auto arguments = std::make_shared<CasesCommand>();
  CLI::App* cases = app.add_subcommand("cases", "Read and revise the case base of a model");
  cases->fallthrough();
  cases->require_subcommand(1);
  CLI::Option* file = cases->add_option("--cases", arguments->cases, "The case base")->type_name("FILE");
  add_model_option(*cases, *arguments, "The model whose case base is used (" + case_base_path("MODEL") + ")")
      ->excludes(file);
  cases->add_flag("--json", arguments->json, "Print JSON");
  add_reading_actions(cases, program, arguments);
  add_writing_actions(cases, program, arguments);
  cases->footer("Example: faultline cases confirm 12 --model bench.json --done \"changed the brake relay\"");
}

}  // namespace faultline
