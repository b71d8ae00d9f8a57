// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "apps/work/file_use.hpp"
#include "formats/open_log.hpp"
#include "lib/diagnose/diagnose_options.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

/// Options that several commands have.
namespace faultline {

CLI::Option* add_model_option(CLI::App& command, ModelPaths& paths,
                              const std::string& what = "Model made by faultline learn");
/// The help is `what` and that MODEL.cases.db is the default.
CLI::Option* add_cases_option(CLI::App& command, ModelPaths& paths, const std::string& what = "Case base");

/// Adds an output file, or - for standard output.
CLI::Option* add_file_option(CLI::App& command, const std::string& flag, std::string& path,
                             const std::string& what, const std::string& where = "; - for standard output");

inline constexpr int kMostThreads = 1024;

/// Adds --threads for work whose result does not depend on it.
CLI::Option* add_threads_option(CLI::App& command, int& threads);

/// Adds --classify, --criterion and --g; `help` replaces their own help.
void add_diagnose_options(CLI::App& command, DiagnoseOptions& options, const std::string& help = "");

/// Adds an option that takes one of `names` and calls `take` with its index.
CLI::Option* add_choice_option(CLI::App& command, const std::string& flag,
                               const std::vector<std::string>& names,
                               const std::function<void(std::size_t)>& take, const std::string& help);

/// Adds an option that takes one of `all` by its name.
template <typename Enum, std::size_t kCount>
CLI::Option* add_choice_option(CLI::App& command, const std::string& flag, Enum& value,
                               const std::array<Enum, kCount>& all, const std::string& help) {
  std::vector<std::string> names;
  for (const Enum one : all) names.push_back(to_string(one));
  return add_choice_option(
      command, flag, names, [&value, all](std::size_t i) { value = all[i]; }, help);
}

/// Adds --join, --join-by, --then and --run, which fill `parts` before the command runs.
void add_log_selection(CLI::App& command, LogSelection& parts);

/// Returns all files of the log except its first one.
std::vector<std::string> files_of(const LogSelection& parts);

}  // namespace faultline
