// SPDX-License-Identifier: MIT
#include "apps/log_selection.hpp"

#include <CLI/CLI.hpp>
#include <map>
#include <string>

namespace faultline {

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
