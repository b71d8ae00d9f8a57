// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "apps/exit_status.hpp"
#include "apps/golden/golden.hpp"
#include "apps/progress.hpp"
#include "lib/core/text.hpp"
#include "lib/golden/golden_folder.hpp"

namespace faultline {
namespace {

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

}  // namespace

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
  add_golden_threads(*command, *arguments);
  command->footer("Example: faultline golden record runs/*.csv --model robot.model -o golden");
  command->callback([arguments, &program] {
    arguments->options.threads = arguments->threads;
    program.run = [arguments, &program] { return run_record(*arguments, program.color); };
  });
}

}  // namespace faultline
