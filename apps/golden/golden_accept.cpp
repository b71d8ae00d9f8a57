// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "apps/exit_status.hpp"
#include "apps/golden/golden.hpp"
#include "apps/progress.hpp"
#include "lib/core/text.hpp"
#include "lib/golden/check_text.hpp"

namespace faultline {
namespace {

std::string sentence(const char* what, const std::vector<std::string>& names) {
  return fmt::format("{}: {}\n", what, printable(fmt::format("{}", fmt::join(names, ", "))));
}

AcceptPlan planned(const AcceptArguments& arguments, ColorChoice color) {
  ProgressBar bar(color);
  return plan_accept(arguments, bar.callback());
}

int run_accept(const AcceptArguments& arguments, ColorChoice color) {
  const AcceptPlan plan = planned(arguments, color);
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

}  // namespace

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
  add_golden_threads(*command, *arguments);
  command->footer(
      "Exit status 0: accepted or nothing to accept, 1: some differences were not accepted.\n"
      "Example: faultline golden accept golden locked_1.csv identification");
  command->callback([arguments, &program] {
    program.run = [arguments, &program] { return run_accept(*arguments, program.color); };
  });
}

}  // namespace faultline
