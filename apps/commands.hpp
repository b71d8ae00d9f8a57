// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include "apps/terminal.hpp"

namespace CLI {
class App;
}

namespace faultline {

/// The request of the command line. `run` is set by the named subcommand and returns the exit status; it runs
/// after parsing, so that a usage error is found before any work.
struct Program {
  ColorChoice color = ColorChoice::automatic;
  std::function<int()> run;
};

/// Makes `work` what the program does if the command is named.
void set_work(CLI::App& command, Program& program, std::function<int(ColorChoice)> work);

// One function per subcommand, each in its own file: adds the subcommand, its options, help and example.
void add_inspect(CLI::App& app, Program& program);
void add_convert(CLI::App& app, Program& program);
void add_cases(CLI::App& app, Program& program);
void add_model(CLI::App& app, Program& program);
void add_simulate(CLI::App& app, Program& program);
void add_identify(CLI::App& app, Program& program);
void add_learn(CLI::App& app, Program& program);
void add_diagnose(CLI::App& app, Program& program);
void add_compare(CLI::App& app, Program& program);
void add_batch(CLI::App& app, Program& program);
void add_history(CLI::App& app, Program& program);
void add_serve(CLI::App& app, Program& program);
void add_golden(CLI::App& app, Program& program);
void add_reproduce(CLI::App& app, Program& program);
void add_help(CLI::App& app, Program& program);
void add_completion(CLI::App& app, Program& program);

/// Adds the subcommand run of golden.
void add_golden_run(CLI::App& golden, Program& program);

/// Exit statuses of the program; scripts rely on them.
inline constexpr int kNothingFound = 0;   ///< done, nothing wrong found
inline constexpr int kFindings = 1;       ///< done, with findings: a fault, a severe issue, a mismatch
inline constexpr int kUsageError = 2;     ///< error in the command line or an option file
inline constexpr int kFileError = 3;      ///< an input cannot be processed or a result cannot be written
inline constexpr int kInternalError = 4;  ///< a defect of the program, or out of memory

/// Runs `work` and returns its status; an exception is printed as one sentence on standard error and gives
/// the status that belongs to it.
int guarded(const std::function<int()>& work);

}  // namespace faultline
