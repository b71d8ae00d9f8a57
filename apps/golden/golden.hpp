// SPDX-License-Identifier: MIT
#pragma once

#include "apps/commands.hpp"
#include "apps/options.hpp"
#include "apps/work/golden_work.hpp"

namespace faultline {

/// Add --model with --cases, --json and --threads, for the actions that have them.
void add_golden_model(CLI::App& command, GoldenArguments& arguments, const char* what);
void add_golden_json(CLI::App& command, GoldenArguments& arguments);
void add_golden_threads(CLI::App& command, GoldenArguments& arguments);

/// Returns 0 when all results are as expected, 1 for a difference, 3 for damage.
int golden_status(const GoldenCheck& check);

// One function per action, each in its own file.
void add_golden_record(CLI::App* golden, Program& program);
void add_golden_check(CLI::App* golden, Program& program);
void add_golden_accept(CLI::App* golden, Program& program);
void add_golden_compare(CLI::App* golden, Program& program);

}  // namespace faultline
