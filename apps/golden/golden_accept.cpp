// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>

#include "apps/exit_status.hpp"
#include "apps/golden/golden.hpp"
#include "lib/core/error.hpp"
#include "lib/core/text.hpp"
#include "lib/golden/accept.hpp"
#include "lib/golden/check_text.hpp"
#include "lib/golden/default_tolerances.hpp"
#include "lib/golden/golden_folder.hpp"

namespace faultline {
namespace {

struct AcceptArguments : GoldenArguments {
  std::vector<std::string> names;
  bool all = false, same_verdict = false;

  bool accepts() const { return all || same_verdict || !names.empty(); }
};

/// The item that the user means: by its name, or without the extension when that is clear.
std::string item_named(const std::string& given, const GoldenCheck& check) {
  std::vector<std::string> stems, names;
  for (const CheckedItem& item : check.items) {
    if (item.name == given) return item.name;
    if (std::filesystem::path(item.name).stem() == given) stems.push_back(item.name);
    names.push_back(item.name);
  }
  if (stems.size() == 1) return stems.front();
  throw Error(ErrorCode::usage, given,
              fmt::format("{}; expected one of {}",
                          stems.empty() ? "is no log of this golden folder" : "could be more than one log",
                          fmt::join(names, ", ")));
}

GoldenCheck only(const GoldenCheck& check, const std::vector<std::string>& names) {
  GoldenCheck part = check;
  std::erase_if(part.items, [&](const CheckedItem& item) {
    return std::find(names.begin(), names.end(), item.name) == names.end();
  });
  return part;
}

std::vector<std::string> named_items(const AcceptArguments& arguments, const GoldenCheck& check) {
  std::vector<std::string> names;
  for (const std::string& given : arguments.names) names.push_back(item_named(given, check));
  if (arguments.names.empty())
    for (const CheckedItem& item : check.items)
      if (!arguments.same_verdict || !item.changes_verdict()) names.push_back(item.name);
  return names;
}

/// Of the named ones those that change; all do with a new model, and where reasons were not recorded yet.
std::vector<std::string> changing(const GoldenCheck& part, bool all) {
  std::vector<std::string> names;
  for (const CheckedItem& item : part.items)
    if (all || !item.same()) names.push_back(item.name);
  return names;
}

/// Of --same-verdict: what stays as it was expected.
std::vector<std::string> found_otherwise(const AcceptArguments& arguments, const GoldenCheck& check) {
  std::vector<std::string> names;
  for (const CheckedItem& item : check.items)
    if (arguments.same_verdict && item.changes_verdict()) names.push_back(item.name);
  return names;
}

std::string sentence(const char* what, const std::vector<std::string>& names) {
  return fmt::format("{}: {}\n", what, printable(fmt::format("{}", fmt::join(names, ", "))));
}

int run_accept(const AcceptArguments& arguments, ColorChoice color) {
  const GoldenSet set = load_golden(arguments.folder);
  const ModelAndCases subject = golden_subject(arguments, set);
  const GoldenRun run = golden_run(arguments, set, subject, color);
  const GoldenCheck check = check_golden(set, run);
  const GoldenCheck part = only(check, named_items(arguments, check));
  const bool in_color = use_color(color, stdout);
  print(render_check_text(arguments.same_verdict ? check : part, in_color), in_color);
  if (!arguments.accepts()) {
    print(part.same() ? "There is nothing to accept.\n"
                      : "Nothing was changed. Name the logs to accept, or give --all.\n");
    return part.same() ? kNothingFound : kFindings;
  }
  const bool new_model = !arguments.model.empty();
  const std::vector<std::string> otherwise = found_otherwise(arguments, check);
  if (!otherwise.empty() && new_model) {
    print(sentence("Nothing was changed. This model finds something else in", otherwise));
    return kFindings;
  }
  if (!otherwise.empty()) print(sentence("Not accepted, since something else is found in", otherwise));
  const int status = otherwise.empty() ? kNothingFound : kFindings;
  const std::vector<std::string> names = changing(part, new_model || !set.tells_reasons);
  if (names.empty()) {
    remove_left_over(arguments.folder, set);
    print("There is nothing to accept.\n");
    return status;
  }
  accept_golden(arguments.folder, set, run, names,
                new_model ? NewModel{arguments.model, arguments.case_base(), &subject} : NewModel{},
                default_tolerances(subject.model));
  remove_left_over(arguments.folder, load_golden(arguments.folder));
  print(sentence(new_model ? "Accepted, with the new model" : "Accepted", names));
  return status;
}

}  // namespace

void add_golden_accept(CLI::App* golden, Program& program) {
  auto arguments = std::make_shared<AcceptArguments>();
  CLI::App* command =
      golden->add_subcommand("accept", "Show what differs and make it what is expected, of the logs named");
  command->fallthrough();
  command->add_option("DIR", arguments->folder, "The golden folder")->required();
  CLI::Option* names =
      command->add_option("NAME", arguments->names, "Logs to accept, or identification; none: only show");
  CLI::Option* all =
      command->add_flag("--all", arguments->all, "Accept everything that differs")->excludes(names);
  command
      ->add_flag("--same-verdict", arguments->same_verdict,
                 "Accept what differs in numbers and reasons only, not in what is found")
      ->excludes(names)
      ->excludes(all);
  add_golden_model(*command, *arguments,
                   "Take this model into the folder; what is expected of logs that are not named stays");
  add_golden_threads(*command, *arguments);
  command->footer(
      "Exit status 0: accepted or nothing to accept, 1: something that differs was not\n"
      "accepted.\n"
      "Example: faultline golden accept golden locked_1.csv identification");
  command->callback([arguments, &program] {
    program.run = [arguments, &program] { return run_accept(*arguments, program.color); };
  });
}

}  // namespace faultline
