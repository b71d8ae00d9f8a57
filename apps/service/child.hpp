// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace faultline {

/// A command of this program that runs as a process of its own: an input that exhausts or ends it does not
/// touch the service.
struct ChildCommand {
  std::string program;
  std::vector<std::string> words;  ///< after the name of the program
  std::string folder;              ///< where it runs
  std::string answer_path;         ///< file for its standard output
  double most_s = 0.0;             ///< it is ended after this time
};

enum class ChildEnd { exited, crashed, timed_out, stopped };

struct ChildRun {
  ChildEnd end = ChildEnd::crashed;
  int status = -1;       ///< exit status; of a crash, the signal
  std::string messages;  ///< its messages on standard error, without progress
};

/// What a watcher learns several times a second.
struct ChildNews {
  std::string step;     ///< of the latest progress line; empty before the first
  double share = -1.0;  ///< 0 to 1; below 0 before the first
};

/// Runs the command and waits for its end; `goes_on` returns false to end it. It ends with the service, even
/// if that is killed. Throws Error(internal) if the system cannot start a process.
ChildRun run_child(const ChildCommand& command, const std::function<bool(const ChildNews&)>& goes_on);

}  // namespace faultline
