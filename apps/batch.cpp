// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>

#include "apps/commands.hpp"
#include "apps/options.hpp"
#include "apps/terminal.hpp"
#include "apps/work/batching.hpp"
#include "lib/batch/batch_exports.hpp"
#include "lib/core/atomic_file.hpp"
#include "lib/model/model_files.hpp"

namespace faultline {
namespace {

std::string duration_text(double seconds) {
  const auto whole = static_cast<long long>(std::ceil(seconds));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
}

/// Returns a callback that shows in the bar the rate of diagnoses and the remaining time at that rate.
std::function<void(const BatchProgress&)> progress_to(ProgressBar& bar) {
  const Progress show = bar.callback();
  if (!show) return {};
  return [show, start = std::chrono::steady_clock::now()](const BatchProgress& at) {
    const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const double rate = at.diagnosed / std::max(elapsed, 1e-3);
    std::string text = fmt::format("{} of {} logs", at.done, at.logs);
    if (at.diagnosed > 0)
      text +=
          fmt::format(", {:.3g} per second, {} remaining", rate, duration_text((at.logs - at.done) / rate));
    show(text, static_cast<double>(at.done) / at.logs);
  };
}

int report(const BatchSummary& summary, const std::string& folder, const std::string& json,
           const std::string& junit) {
  if (!json.empty()) write_file(json, to_json(summary));
  if (!junit.empty()) write_file(junit, batch_junit(rows_of_batch(folder)));
  if (json != "-" && junit != "-") print(to_text(summary) + "Look at " + folder + "/index.html\n");
  return summary.status;
}

/// Takes the models of the command line; `cases` is the case base of a single model.
void take_models(const std::vector<std::string>& given, const std::string& cases, BatchRequest& request) {
  for (const std::string& argument : given) request.models.push_back(batch_model_of(argument));
  if (cases.empty()) return;
  if (given.size() > 1)
    throw Error(ErrorCode::usage, "--cases " + cases,
                "applies to a batch with one model; of several models, each uses the case base beside it");
  request.models.front().files.cases = cases;
}

std::vector<ModelFiles> load(const std::vector<BatchModel>& models) {
  std::vector<ModelFiles> loaded;
  for (const BatchModel& model : models)
    loaded.push_back(load_model_files(model.files.model, model.files.case_base()));
  return loaded;
}

struct BatchArguments : BatchRequest {
  std::vector<std::string> given;  ///< of --model: MODEL or DIR=MODEL
  std::string cases;
};

int run_command(BatchArguments request, ColorChoice color) {
  BatchOptions& options = request.options;
  take_shard(request.shard, options);
  joint_pairs(options.twins, "--twins");
  take_models(request.given, request.cases, request);
  const std::vector<BatchLog> logs = claimed_logs(request);
  const std::vector<ModelFiles> models = load(request.models);
  BatchResult result;
  {
    ProgressBar bar(color);
    options.progress = progress_to(bar);
    result = run_batch_on(logs, models, request);
  }
  const int done = result.summary.all.logs - result.diagnosed;
  if (done > 0) print_message(fmt::format("{} of {} logs were done before", done, result.summary.all.logs));
  return report(result.summary, request.folder, request.json, request.junit);
}

void add_merge(CLI::App& batch, Program& program) {
  auto folders = std::make_shared<std::vector<std::string>>();
  auto into = std::make_shared<std::string>(), json = std::make_shared<std::string>(),
       junit = std::make_shared<std::string>();
  CLI::App* merge = batch.add_subcommand("merge", "Put the results of all shards into one folder");
  merge->add_option("OUT", *folders, "Folders of finished shards")->required();
  merge->add_option("-o,--output", *into, "Folder for the merged results")->required()->type_name("DIR");
  add_file_option(*merge, "--json", *json, "Write the summary as JSON");
  add_file_option(*merge, "--junit", *junit, "Write JUnit XML with a test case for each log");
  merge->footer("Example: faultline batch merge out/part-* -o out/all");
  merge->callback([=, &program] {
    program.run = [=] { return report(merge_shards(*folders, *into, *json, *junit), *into, *json, *junit); };
  });
}

void add_options(CLI::App& command, BatchArguments& arguments) {
  command.add_option("PATH", arguments.paths, "Logs, and folders that hold logs, with their subfolders");
  command
      .add_option(
          "--model", arguments.given,
          "Model made by faultline learn; DIR=MODEL for the logs below folder DIR (may be given several "
          "times)")
      ->type_name("[DIR=]MODEL")
      ->allow_extra_args(false);
  command
      .add_option("-o,--output", arguments.folder,
                  "Folder for the results; an earlier run there is continued")
      ->type_name("DIR");
  command.add_option("--cases", arguments.cases, "Case base of the only model, MODEL.cases.db by default")
      ->type_name("FILE");
  command.add_flag("--html", arguments.options.html, "Also write a page for each log");
  command.add_flag("--identify", arguments.options.identify,
                   "Identify the robot from each healthy log alone, and show the trend of its parameters");
  command
      .add_option(
          "--twins", arguments.options.twins,
          "Pairs of joints of a kind, such as 1:4,2:5 for left and right; lists a pair that differs from "
          "the others")
      ->type_name("PAIRS");
  add_file_option(command, "--json", arguments.json, "Write the summary as JSON");
  add_file_option(command, "--junit", arguments.junit, "Write JUnit XML with a test case for each log");
  command
      .add_option("--threads", arguments.options.threads,
                  "Number of logs diagnosed at once; 0 = one per core")
      ->check(CLI::Range(0, 1024))
      ->type_name("N");
  command.add_option("--shard", arguments.shard, "Diagnose only part I of N of the list of logs")
      ->type_name("I/N");
  command.add_flag("--wait", arguments.options.wait, "Wait while another batch writes into the same folder");
  add_diagnose_options(command, arguments.options.diagnose, "As for faultline diagnose");
}

void refuse_incomplete(const BatchArguments& arguments) {
  if (arguments.paths.empty()) throw CLI::RequiredError("PATH (a log or a folder)");
  if (arguments.given.empty()) throw CLI::RequiredError("--model");
  if (arguments.folder.empty()) throw CLI::RequiredError("-o,--output");
}

}  // namespace

void add_batch(CLI::App& app, Program& program) {
  auto arguments = std::make_shared<BatchArguments>();
  CLI::App* command =
      app.add_subcommand("batch", "Diagnose all logs of folders, with an index of the results");
  add_options(*command, *arguments);
  add_merge(*command, program);
  command->footer(
      "Run the same command again to continue after an interruption.\n"
      "Exit status: the worst of all logs. 0: healthy, 1: faults or no verdict, 3: a log cannot be used.\n"
      "Example: faultline batch runs/ --model robot.model -o out/runs");
  command->callback([arguments, command, &program] {
    if (command->got_subcommand("merge")) return;
    refuse_incomplete(*arguments);
    program.run = [arguments, &program] { return run_command(*arguments, program.color); };
  });
}

}  // namespace faultline
