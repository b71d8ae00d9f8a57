// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "apps/commands.hpp"
#include "apps/exit_status.hpp"
#include "lib/cases/case_file.hpp"
#include "lib/cases/case_json.hpp"
#include "lib/core/atomic_file.hpp"
#include "lib/core/error.hpp"
#include "lib/core/number_text.hpp"
#include "lib/core/text.hpp"
#include "lib/fault/fault_words.hpp"
#include "lib/report/case_from_json.hpp"

namespace faultline {
namespace {

struct CasesArguments {
  std::string cases, model;  // where the case base is
  bool json = false;
  std::int64_t id = 0;
  std::string fault, outcome, done, diagnosis, file = "-";
  int joint = 0, fault_id = 1;
  bool replace = false, merge = false;

  std::string path() const {
    if (cases.empty() == model.empty())
      throw Error(ErrorCode::usage, "faultline cases", "needs either --cases FILE or --model MODEL");
    return cases.empty() ? model + ".cases.db" : cases;
  }
  std::optional<FaultLabel> label() const {
    if (fault.empty() && joint == 0) return {};
    if (fault.empty()) throw Error(ErrorCode::usage, "--joint", "needs --fault KIND beside it");
    return FaultLabel{fault_kind_from(fault), joint};
  }
};
using Arguments = std::shared_ptr<CasesArguments>;

std::string one_line(const Case& c) {
  const std::string done = c.what_was_done.empty() ? "" : "; done: " + c.what_was_done;
  return printable(fmt::format("{:>6}  {:<12} {:<40} {}{}", c.id, to_string(c.outcome), plain_words(c.label),
                               c.origin, done)) +
         "\n";
}

std::string in_full(const CaseBase& base, const Case& c) {
  const auto opinion = [](const char* network, const Opinion& o) {
    return fmt::format("  {:<9}{} ({:.2f})\n", network, plain_words(o.label), o.confidence);
  };
  std::string text = fmt::format("Case {}: {} ({})\n", c.id, plain_words(c.label), to_string(c.outcome));
  text += fmt::format("  decided  {}\n", plain_words(c.decision));
  text += opinion("MLP", c.episode.mlp) + opinion("RBFN", c.episode.rbfn);
  text += fmt::format("  evidence {}\n  origin   {}\n  done     {}\n  features (value, scale, weight)\n",
                      value_text(c.episode.evidence), printable(c.origin), printable(c.what_was_done));
  for (std::size_t i = 0; i < c.episode.features.size(); ++i) {
    const Feature& f = base.metric().features[i];
    text += fmt::format("    {:<32} {:>10} {:>10} {:>6.2f}\n", printable(f.name),
                        value_text(c.episode.features[i]), value_text(f.scale), f.weight);
  }
  return text;
}

void print_case(const CaseBase& base, const Case& c, const CasesArguments& arguments,
                const std::string& text) {
  print(arguments.json ? to_json(base, c).dump(2) + "\n" : text);
}

bool is_asked_for(const Case& c, const CasesArguments& arguments) {
  if (!arguments.outcome.empty() && c.outcome != case_outcome_from(arguments.outcome)) return false;
  if (!arguments.fault.empty() && c.label.kind != fault_kind_from(arguments.fault)) return false;
  return arguments.joint == 0 || c.label.joint == arguments.joint;
}

int list(const CasesArguments& arguments) {
  const CaseBase base = read_case_base(arguments.path());
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  std::string text;
  int shown = 0;
  for (const Case& c : base.cases()) {
    if (!is_asked_for(c, arguments)) continue;
    ++shown;
    if (arguments.json)
      json.push_back(to_json(base, c));
    else
      text += one_line(c);
  }
  print(arguments.json ? json.dump(2) + "\n"
                       : text + fmt::format("{} of {} cases\n", shown, base.cases().size()));
  return kNothingFound;
}

int show(const CasesArguments& arguments) {
  const CaseBase base = read_case_base(arguments.path());
  const Case& c = base.at(arguments.id);
  print_case(base, c, arguments, in_full(base, c));
  return kNothingFound;
}

/// Changes the base in one transaction and prints the case whose id `change` returns.
int change_and_print(const CasesArguments& arguments, const std::function<std::int64_t(CaseBase&)>& change) {
  CaseBase changed;
  std::int64_t id = 0;
  change_case_base(arguments.path(), [&](CaseBase& base) {
    id = change(base);
    changed = base;
  });
  print_case(changed, changed.at(id), arguments, one_line(changed.at(id)));
  return kNothingFound;
}

Case new_case(const CasesArguments& arguments, const CaseBase& base) {
  Case c;
  if (!arguments.diagnosis.empty())
    c = case_from_json(read_file(arguments.diagnosis), arguments.diagnosis, arguments.fault_id,
                       base.feature_names());
  else if (const auto label = arguments.label()) {
    c.decision = *label;
    c.episode.features.assign(base.metric().features.size(), std::numeric_limits<double>::quiet_NaN());
    c.origin = "recorded by hand";
    std::fputs("faultline: the case has no measured features, so no diagnosis will find it similar\n",
               stderr);
  } else
    throw Error(ErrorCode::usage, "faultline cases add", "needs a diagnosis (JSON report) or --fault KIND");
  c.what_was_done = arguments.done;
  return c;
}

int add(const CasesArguments& arguments) {
  return change_and_print(arguments, [&](CaseBase& base) {
    const auto id = base.retain(new_case(arguments, base));
    if (arguments.label()) base.confirm(id, arguments.label());
    return id;
  });
}

int confirm(const CasesArguments& arguments) {
  return change_and_print(arguments, [&](CaseBase& base) {
    base.confirm(arguments.id, arguments.label(), arguments.done);
    return arguments.id;
  });
}

int reject(const CasesArguments& arguments) {
  return change_and_print(arguments, [&](CaseBase& base) {
    base.reject(arguments.id, arguments.label(), arguments.done);
    return arguments.id;
  });
}

int export_cases(const CasesArguments& arguments) {
  write_file(arguments.file, to_cases_json(read_case_base(arguments.path())));
  return kNothingFound;
}

int import_cases(const CasesArguments& arguments) {
  const CaseBase imported = from_cases_json(read_file(arguments.file), arguments.file);
  const std::string path = arguments.path();
  std::int64_t added = std::ssize(imported.cases());
  if (arguments.merge)
    change_case_base(path, [&](CaseBase& base) { added = base.merge(imported); });
  else if (std::filesystem::exists(path) && !arguments.replace)
    throw Error(ErrorCode::usage, path, "is there already; choose --merge to add to it or --replace");
  else
    write_case_base(path, imported);
  const nlohmann::ordered_json json = {{"read", imported.cases().size()}, {"added", added}};
  print(arguments.json ? json.dump(2) + "\n"
                       : fmt::format("{} cases read, {} added\n", imported.cases().size(), added));
  return kNothingFound;
}

CLI::App* add_action(CLI::App* cases, Program& program, const Arguments& arguments, const std::string& name,
                     const std::string& what, int (*action)(const CasesArguments&)) {
  CLI::App* command = cases->add_subcommand(name, what);
  command->fallthrough();
  command->callback(
      [arguments, action, &program] { program.run = [arguments, action] { return action(*arguments); }; });
  return command;
}

void add_label(CLI::App* command, const Arguments& arguments, const std::string& what) {
  command->add_option("--fault", arguments->fault, what)->type_name("KIND");
  command->add_option("--joint", arguments->joint, "Joint of that fault, from 1")
      ->check(CLI::NonNegativeNumber);
}

void add_reading_actions(CLI::App* cases, Program& program, const Arguments& arguments) {
  CLI::App* command = add_action(cases, program, arguments, "list", "List cases, one a line", list);
  add_label(command, arguments, "Only cases of this fault");
  command->add_option("--outcome", arguments->outcome, "Only unconfirmed, confirmed or rejected ones");
  command->footer("Example: faultline cases list --model bench.json --outcome unconfirmed");
  command = add_action(cases, program, arguments, "show", "Show one case in full", show);
  command->add_option("ID", arguments->id, "Number of the case")->required();
  command->footer("Example: faultline cases show 12 --model bench.json");
  command =
      add_action(cases, program, arguments, "export", "Write all cases as JSON, without loss", export_cases);
  command->add_option("-o,--output", arguments->file, "File, - for standard output (default)");
  command->footer("Example: faultline cases export --model bench.json -o cases.json");
}

void add_revision(CLI::App* cases, Program& program, const Arguments& arguments, const std::string& name,
                  const std::string& what, const std::string& label, int (*action)(const CasesArguments&)) {
  CLI::App* command = add_action(cases, program, arguments, name, what, action);
  command->add_option("ID", arguments->id, "Number of the case")->required();
  add_label(command, arguments, label);
  command->add_option("--done", arguments->done, "What was done about it")->type_name("TEXT");
  command->footer("Example: faultline cases " + name +
                  " 12 --model bench.json --done \"changed the brake relay\"");
}

void add_writing_actions(CLI::App* cases, Program& program, const Arguments& arguments) {
  CLI::App* command = add_action(cases, program, arguments, "add", "Add a diagnosed fault as a case", add);
  command->add_option("DIAGNOSIS", arguments->diagnosis, "JSON report of faultline diagnose");
  command->add_option("--fault-id", arguments->fault_id, "Number of the fault in the report (default 1)");
  add_label(command, arguments, "What it really was; the case is then confirmed");
  command->add_option("--done", arguments->done, "What was done about it")->type_name("TEXT");
  command->footer(
      "Example: faultline cases add report.json --fault-id 1 --fault locked --joint 2 --model bench.json");
  add_revision(cases, program, arguments, "confirm", "Say that a case was decided right",
               "What it was, if not that", confirm);
  add_revision(cases, program, arguments, "reject", "Say that a case was decided wrong",
               "What it was, if known", reject);
  command = add_action(cases, program, arguments, "import", "Make a case base from an export", import_cases);
  command->add_option("FILE", arguments->file, "File written by export, - for standard input")->required();
  CLI::Option* merge = command->add_flag("--merge", arguments->merge, "Add the cases that are new to a base");
  command->add_flag("--replace", arguments->replace, "Replace a base that is there")->excludes(merge);
  command->footer("Example: faultline cases import cases.json --cases bench.json.cases.db");
}

}  // namespace

void add_cases(CLI::App& app, Program& program) {
  auto arguments = std::make_shared<CasesArguments>();
  CLI::App* cases = app.add_subcommand("cases", "Read and revise the case base of a model");
  cases->fallthrough();
  cases->require_subcommand(1);
  CLI::Option* file = cases->add_option("--cases", arguments->cases, "The case base")->type_name("FILE");
  cases->add_option("--model", arguments->model, "The model whose case base is meant (MODEL.cases.db)")
      ->type_name("MODEL")
      ->excludes(file);
  cases->add_flag("--json", arguments->json, "Print JSON");
  add_reading_actions(cases, program, arguments);
  add_writing_actions(cases, program, arguments);
  cases->footer("Example: faultline cases confirm 12 --model bench.json --done \"changed the brake relay\"");
}

}  // namespace faultline
