// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "apps/work/file_use.hpp"
#include "lib/golden/check.hpp"
#include "lib/golden/new_run.hpp"
#include "lib/golden/record.hpp"
#include "lib/golden/replay.hpp"

/// The actions of faultline golden without their output.
namespace faultline {

/// Arguments that the actions of faultline golden share; without --model, the folder's own model is used.
struct GoldenArguments : ModelPaths {
  std::string folder;
  std::string json, junit;
  int threads = 0;
};

/// Replays the folder's logs.
GoldenRun golden_run(const GoldenArguments& arguments, const GoldenSet& set, const ModelAndCases& subject,
                     const Progress& progress);
/// Adds the inputs of an action: the folder's files as `set` names them, and --model with its case base.
void reads_golden(FileUse& files, const GoldenArguments& arguments, const GoldenSet& set);

struct RecordArguments : GoldenArguments {
  std::vector<std::string> logs;
  RecordOptions options;
};
/// Removes tables of labels from the logs, as a shell expands runs/*.csv to its labels.csv too, and returns
/// them. Throws Error(usage) when no log remains.
std::vector<std::string> skip_label_tables(std::vector<std::string>& logs);
Recorded record_folder(const RecordArguments& arguments, const Progress& progress);

struct CheckedFolder {
  GoldenRun run;
  GoldenCheck check;
};
/// Replays all logs of the folder and compares; writes --json and --junit if requested.
CheckedFolder check_folder(const GoldenArguments& arguments, const Progress& progress);

struct AcceptArguments : GoldenArguments {
  std::vector<std::string> names;
  bool all = false, same_verdict = false;

  bool accepts() const { return all || same_verdict || !names.empty(); }
  bool has_new_model() const { return !model.empty(); }
};

/// The differences, and those that will be accepted.
struct AcceptPlan {
  GoldenSet set;
  ModelAndCases subject;
  GoldenRun run;
  GoldenCheck check, part;             ///< all items, and the named ones
  std::vector<std::string> otherwise;  ///< of --same-verdict: unchanged items, as their verdict differs
  std::vector<std::string> names;      ///< of items that change

  bool is_refused(const AcceptArguments& arguments) const {
    return !arguments.accepts() || (arguments.has_new_model() && !otherwise.empty());
  }
};
AcceptPlan plan_accept(const AcceptArguments& arguments, const Progress& progress);
/// Makes the results of the plan's names the expected ones; for a plan that is not refused.
void carry_out(const AcceptPlan& plan, const AcceptArguments& arguments);

/// New runs that are held against a folder.
struct NewRunArguments {
  std::vector<std::string> logs;
  std::string folder;
  std::string json, junit;
};
/// Checks each log against the recorded runs that are expected to be healthy, with the tolerances of
/// runs.toml in the folder, if it is there. Throws Error(usage) for a mistake in that file or a folder
/// without healthy runs, Error(input) for a damaged recorded run or an unreadable log.
std::vector<NewRunCheck> check_new_runs(const NewRunArguments& arguments);

}  // namespace faultline
