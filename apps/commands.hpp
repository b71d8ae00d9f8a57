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
void add_golden(CLI::App& app, Program& program);
void add_reproduce(CLI::App& app, Program& program);
void add_help(CLI::App& app, Program& program);
void add_completion(CLI::App& app, Program& program);

}  // namespace faultline
