// SPDX-License-Identifier: MIT
#include "apps/options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <string>

#include "lib/cases/case_file.hpp"

namespace faultline {

CLI::Option* add_model_option(CLI::App& command, ModelPaths& paths, const std::string& what) {
  return command.add_option("--model", paths.model, what)->type_name("MODEL");
}

CLI::Option* add_cases_option(CLI::App& command, ModelPaths& paths, const std::string& what) {
  return command.add_option("--cases", paths.cases, what + ", " + case_base_path("MODEL") + " by default")
      ->type_name("FILE");
}

CLI::Option* add_file_option(CLI::App& command, const std::string& flag, std::string& path,
                             const std::string& what, const std::string& where) {
  return command.add_option(flag, path, what + where)->type_name("F");
}

CLI::Option* add_threads_option(CLI::App& command, int& threads) {
  return command
      .add_option("--threads", threads,
                  "Number of threads, 0 = one per core; the result does not depend on it")
      ->check(CLI::Range(0, kMostThreads))
      ->capture_default_str();
}

void add_diagnose_options(CLI::App& command, DiagnoseOptions& options, const std::string& help) {
  const auto words = [&](const char* own) { return help.empty() ? own : help; };
  add_choice_option(
      command, "--classify", options.mode, kClassifyModes,
      words("evidence: hypotheses on the identified robot, classified by both networks; samples: the "
            "method of the paper, both networks on the residuals of each sample"))
      ->default_str(to_string(options.mode));
  add_choice_option(command, "--criterion", options.criterion, kCriterionKinds,
                    words("With --classify samples: sum of log odds, or g consecutive samples (the paper)"))
      ->default_str(to_string(options.criterion));
  command
      .add_option("--g", options.g,
                  words("With --criterion consecutive: number of samples; 0 = as tuned by learn"))
      ->check(CLI::NonNegativeNumber);
}

CLI::Option* add_choice_option(CLI::App& command, const std::string& flag,
                               const std::vector<std::string>& names,
                               const std::function<void(std::size_t)>& take, const std::string& help) {
  const auto take_named = [names, take](const std::string& name) {
    take(static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin()));
  };
  return command.add_option_function<std::string>(flag, take_named, help)->check(CLI::IsMember(names));
}

void add_log_selection(CLI::App& command, LogSelection& parts) {
  static const std::map<std::string, JoinBy> ways{
      {"auto", JoinBy::automatic}, {"row", JoinBy::row}, {"time", JoinBy::time}};
  command.add_option("--join", parts.join, "A file with more columns of the log; may be given several times")
      ->type_name("FILE")
      ->allow_extra_args(false);
  command
      .add_option("--join-by", parts.by,
                  "How rows are matched: time, row, or auto (by time if both files have one)")
      ->transform(CLI::CheckedTransformer(ways).description("{auto,row,time}"))
      ->type_name("HOW");
  command.add_option("--then", parts.then, "A file that continues the log; may be given several times")
      ->type_name("FILE")
      ->allow_extra_args(false);
  command
      .add_option(
          "--run", parts.run,
          "Read only this run, counted from 1, of a log in which the clock restarts; default: all runs, "
          "one after the other")
      ->check(CLI::PositiveNumber)
      ->type_name("N");
}

std::vector<std::string> files_of(const LogSelection& parts) {
  std::vector<std::string> files = parts.join;
  files.insert(files.end(), parts.then.begin(), parts.then.end());
  return files;
}

}  // namespace faultline
