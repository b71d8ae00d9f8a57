// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "apps/commands.hpp"
#include "apps/options.hpp"
#include "lib/golden/check.hpp"
#include "lib/golden/replay.hpp"

namespace faultline {

/// What the actions of faultline golden have in common; without --model the folder's own model is meant.
struct GoldenArguments : ModelPaths {
  std::string folder;
  std::string json, junit;
  int threads = 0;
};

/// Adds --model with --cases, --json and --threads, as far as an action has them.
void add_golden_model(CLI::App& command, GoldenArguments& arguments, const char* what);
void add_golden_json(CLI::App& command, GoldenArguments& arguments);
void add_golden_threads(CLI::App& command, GoldenArguments& arguments);

/// Opens a log as the model's robot file says.
std::unique_ptr<LogSource> open_golden_log(const std::string& path, const Model& model);

/// That of --model, else the folder's.
ModelAndCases golden_subject(const GoldenArguments& arguments, const GoldenSet& set);
/// Replays the folder's logs, with a progress bar.
GoldenRun golden_run(const GoldenArguments& arguments, const GoldenSet& set, const ModelAndCases& subject,
                     ColorChoice color);
class FileUse;
/// Adds what an action reads: the folder's files as `set` names them, and --model with its case base.
void reads_golden(FileUse& files, const GoldenArguments& arguments, const GoldenSet& set);
/// 0 when all is as expected, 1 for a difference, 3 for damage.
int golden_status(const GoldenCheck& check);

// One function an action, each in its own file.
void add_golden_record(CLI::App* golden, Program& program);
void add_golden_check(CLI::App* golden, Program& program);
void add_golden_accept(CLI::App* golden, Program& program);
void add_golden_compare(CLI::App* golden, Program& program);

}  // namespace faultline
