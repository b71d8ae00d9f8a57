// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <set>

#include "apps/exit_status.hpp"
#include "apps/file_use.hpp"
#include "apps/folder.hpp"
#include "apps/golden/golden.hpp"
#include "apps/labels.hpp"
#include "apps/progress.hpp"
#include "lib/core/error.hpp"
#include "lib/core/files/output_place.hpp"
#include "lib/core/text.hpp"
#include "lib/golden/record.hpp"

namespace faultline {
namespace {

struct RecordArguments : GoldenArguments {
  std::vector<std::string> logs;
  RecordOptions options;
  bool no_identification = false;
};

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
  return text + fmt::format("Recorded {} logs. Look at {}, then commit the folder.\n",
                            recorded.set.logs.size(), printable(golden_file(folder)));
}

/// A log that lies in the folder's logs/ already stays as it is.
void claim_files(const RecordArguments& arguments) {
  FileUse files;
  files.reads(arguments).writes("-o", golden_file(arguments.folder));
  std::set<std::string> copies;  // two logs of one name are refused later
  for (const std::string& log : arguments.logs) {
    const std::string copy =
        (std::filesystem::path(arguments.folder) / "logs" / std::filesystem::path(log).filename()).string();
    files.reads("the log", log);
    if (copies.insert(copy).second && file_identity(copy) != file_identity(log)) files.writes("-o", copy);
  }
  files.claim();
}

/// A shell that names runs/*.csv names its labels.csv, too.
std::vector<std::string> skip_label_tables(std::vector<std::string>& logs) {
  const auto first = std::stable_partition(logs.begin(), logs.end(),
                                           [](const std::string& log) { return !is_label_table(log); });
  std::vector<std::string> skipped(first, logs.end());
  logs.erase(first, logs.end());
  return skipped;
}

int run_record(RecordArguments arguments, ColorChoice color) {
  for (const std::string& table : skip_label_tables(arguments.logs))
    print(printable(table) + " is a table of labels, no log; it is skipped.\n");
  if (arguments.logs.empty())
    throw Error(ErrorCode::usage, "faultline golden record",
                "was given tables of labels only; name logs, too");
  claim_files(arguments);
  make_folder(arguments.folder);
  ProgressBar bar(color);
  const Recorded recorded =
      record_golden(arguments.folder, arguments.logs, arguments.model, arguments.case_base(), open_golden_log,
                    arguments.options, bar.callback());
  print(recorded_text(recorded, arguments.folder));
  return kNothingFound;
}

}  // namespace

void add_golden_record(CLI::App* golden, Program& program) {
  auto arguments = std::make_shared<RecordArguments>();
  CLI::App* command =
      golden->add_subcommand("record", "Make a golden folder: logs, model and what faultline says now");
  command->fallthrough();
  command->add_option("LOG", arguments->logs, "Small logs, healthy ones and such with faults")->required();
  add_golden_model(*command, *arguments, "Model made by faultline learn");
  command->get_option("--model")->required();
  command->add_option("-o,--output", arguments->folder, "The folder to make")->required()->type_name("DIR");
  command->add_flag("--no-identification", arguments->no_identification,
                    "Do not identify the robot from the healthy logs");
  command
      ->add_option("--trace-points", arguments->options.trace_points,
                   "Points of the predicted motion to keep of a log, at most")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  add_golden_threads(*command, *arguments);
  command->footer("Example: faultline golden record runs/*.csv --model robot.model -o golden");
  command->callback([arguments, &program] {
    arguments->options.identify = !arguments->no_identification;
    arguments->options.threads = arguments->threads;
    program.run = [arguments, &program] { return run_record(*arguments, program.color); };
  });
}

}  // namespace faultline
