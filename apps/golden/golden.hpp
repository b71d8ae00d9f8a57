// SPDX-License-Identifier: MIT
#pragma once

#include "apps/commands.hpp"
#include "apps/options.hpp"
#include "apps/work/golden_work.hpp"

namespace faultline {

/// Adds --model with --cases, --json and --threads, as far as an action has them.
void add_golden_model(CLI::App& command, GoldenArguments& arguments, const char* what);
void add_golden_json(CLI::App& command, GoldenArguments& arguments);
void add_golden_threads(CLI::App& command, GoldenArguments& arguments);

/// 0 when all is as expected, 1 for a difference, 3 for damage.
int golden_status(const GoldenCheck& check);

// One function an action, each in its own file.
void add_golden_record(CLI::App* golden, Program& program);
void add_golden_check(CLI::App* golden, Program& program);
void add_golden_accept(CLI::App* golden, Program& program);
void add_golden_compare(CLI::App* golden, Program& program);

}  // namespace faultline
