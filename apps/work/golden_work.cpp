// SPDX-License-Identifier: MIT
#include "apps/work/golden_work.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <set>

#include "apps/work/comparison.hpp"
#include "apps/work/file_use.hpp"
#include "apps/work/labels.hpp"
#include "apps/work/robot_log.hpp"
#include "formats/open_log.hpp"
#include "lib/core/atomic_file.hpp"
#include "lib/core/error.hpp"
#include "lib/core/files/inner_file.hpp"
#include "lib/core/files/output_place.hpp"
#include "lib/golden/check.hpp"
#include "lib/golden/golden_folder.hpp"
#include "lib/golden/tolerance.hpp"

namespace faultline {
namespace {

/// Claims the files to record. A log that is already in the folder's logs/ is not replaced.
void claim_files(const RecordArguments& arguments) {
  FileUse files;
  files.reads(arguments).writes_kept("-o", golden_file(arguments.folder));
  std::set<std::string> copies;  // two logs of one name are rejected later
  for (const std::string& log : arguments.logs) {
    const std::string copy =
        (std::filesystem::path(arguments.folder) / "logs" / std::filesystem::path(log).filename()).string();
    files.reads("the log", log);
    if (copies.insert(copy).second && file_identity(copy) != file_identity(log))
      files.writes_kept("-o", copy);
  }
  files.claim();
}

/// Throws Error(usage) for a log of several files, as a golden folder keeps one file a log.
void refuse_logs_of_several_files(const std::vector<std::string>& logs) {
  for (const std::string& log : logs)
    if (const std::vector<std::string> beside = files_beside(log); !beside.empty())
      throw Error(
          ErrorCode::usage, log,
          "has its values in another file, " + beside.front() +
              ", but a golden folder keeps one file a log; write one first: faultline convert LOG run.flog");
}

/// Returns the folder's own name, without its path on this machine.
std::string suite_name(const std::string& folder) {
  const std::filesystem::path path = std::filesystem::weakly_canonical(folder);
  return path.has_filename() ? path.filename().string() : path.parent_path().filename().string();
}

/// Returns the item with the given name, or with that name without extension if it is unique.
std::string item_named(const std::string& given, const GoldenCheck& check) {
  std::vector<std::string> stems, names;
  for (const CheckedItem& item : check.items) {
    if (item.name == given) return item.name;
    if (std::filesystem::path(item.name).stem() == given) stems.push_back(item.name);
    names.push_back(item.name);
  }
  if (stems.size() == 1) return stems.front();
  throw Error(ErrorCode::usage, given,
              fmt::format("{}; expected one of {}",
                          stems.empty() ? "is not a log of this golden folder" : "matches more than one log",
                          fmt::join(names, ", ")));
}

/// Returns the names of the items that are wanted.
template <typename Wanted>
std::vector<std::string> item_names(const GoldenCheck& check, Wanted is_wanted) {
  std::vector<std::string> names;
  for (const CheckedItem& item : check.items)
    if (is_wanted(item)) names.push_back(item.name);
  return names;
}

GoldenCheck only(const GoldenCheck& check, const std::vector<std::string>& names) {
  GoldenCheck part = check;
  std::erase_if(part.items, [&](const CheckedItem& item) {
    return std::find(names.begin(), names.end(), item.name) == names.end();
  });
  return part;
}

std::vector<std::string> named_items(const AcceptArguments& arguments, const GoldenCheck& check) {
  std::vector<std::string> names;
  for (const std::string& given : arguments.names) names.push_back(item_named(given, check));
  if (!names.empty()) return names;
  return item_names(
      check, [&](const CheckedItem& item) { return !arguments.same_verdict || !item.changes_verdict(); });
}

/// Opens a log with the model's robot file.
std::unique_ptr<LogSource> open_golden_log(const std::string& path, const Model& model) {
  return open_robot_log(path, model.robot);
}

/// Returns the model of --model, else the folder's.
ModelAndCases golden_subject(const GoldenArguments& arguments, const GoldenSet& set) {
  return arguments.model.empty() ? load_golden_model(arguments.folder, set)
                                 : load_model_and_cases(arguments.model, arguments.case_base());
}

}  // namespace

GoldenRun golden_run(const GoldenArguments& arguments, const GoldenSet& set, const ModelAndCases& subject,
                     const Progress& progress) {
  return replay(replay_logs(arguments.folder, set), subject, open_golden_log,
                {set.trace_points, arguments.threads}, progress);
}

void reads_golden(FileUse& files, const GoldenArguments& arguments, const GoldenSet& set) {
  const std::string what = "the golden folder's", folder = arguments.folder + "/";
  files.reads(what, golden_file(arguments.folder));
  for (const GoldenLog& log : set.logs)
    files.reads(what, folder + log.log.path).reads(what, folder + log.trace.path);
  files.reads(ModelPaths{folder + set.model.path, folder + set.cases.path}).reads(arguments);
}

std::vector<std::string> skip_label_tables(std::vector<std::string>& logs) {
  const auto first = std::stable_partition(logs.begin(), logs.end(),
                                           [](const std::string& log) { return !is_label_table(log); });
  std::vector<std::string> skipped(first, logs.end());
  logs.erase(first, logs.end());
  if (logs.empty())
    throw Error(ErrorCode::usage, "faultline golden record",
                "was given only tables of labels; name logs as well");
  return skipped;
}

Recorded record_folder(const RecordArguments& arguments, const Progress& progress) {
  claim_files(arguments);
  refuse_logs_of_several_files(arguments.logs);
  make_folder(arguments.folder);
  return record_golden(arguments.folder, arguments.logs, arguments.model, arguments.case_base(),
                       open_golden_log, arguments.options, progress);
}

CheckedFolder check_folder(const GoldenArguments& arguments, const Progress& progress) {
  const GoldenSet set = load_golden(arguments.folder);
  FileUse files;
  reads_golden(files, arguments, set);
  files.writes("--json", arguments.json).writes("--junit", arguments.junit).claim();
  const ModelAndCases subject = golden_subject(arguments, set);
  CheckedFolder checked{golden_run(arguments, set, subject, progress), {}};
  checked.check = check_golden(set, checked.run);
  if (!arguments.json.empty()) write_file(arguments.json, render_check_json(checked.check, checked.run));
  if (!arguments.junit.empty())
    write_file(arguments.junit, render_check_junit(checked.check, suite_name(arguments.folder)));
  return checked;
}

AcceptPlan plan_accept(const AcceptArguments& arguments, const Progress& progress) {
  AcceptPlan plan;
  plan.set = load_golden(arguments.folder);
  plan.subject = golden_subject(arguments, plan.set);
  plan.run = golden_run(arguments, plan.set, plan.subject, progress);
  plan.check = check_golden(plan.set, plan.run);
  plan.part = only(plan.check, named_items(arguments, plan.check));
  plan.otherwise = item_names(
      plan.check, [&](const CheckedItem& item) { return arguments.same_verdict && item.changes_verdict(); });
  plan.names = item_names(plan.part,
                          [&](const CheckedItem& item) { return arguments.has_new_model() || !item.same(); });
  return plan;
}

void carry_out(const AcceptPlan& plan, const AcceptArguments& arguments) {
  const std::string& folder = arguments.folder;
  if (plan.names.empty()) {
    remove_orphaned_files(folder, plan.set);
    return;
  }
  const NewModel model = arguments.has_new_model() ? NewModel{arguments.model, &plan.subject} : NewModel{};
  accept_golden(folder, plan.set, plan.run, plan.names, model, default_tolerances(plan.subject.model));
  remove_orphaned_files(folder, load_golden(folder));
}

std::vector<NewRunCheck> check_new_runs(const NewRunArguments& arguments) {
  const GoldenSet set = load_golden(arguments.folder);
  FileUse files;
  for (const std::string& log : arguments.logs) files.reads("the log", log);
  GoldenArguments folder;
  folder.folder = arguments.folder;
  reads_golden(files, folder, set);
  files.writes("--json", arguments.json).writes("--junit", arguments.junit).claim();
  const Model model = load_golden_model(arguments.folder, set).model;
  std::vector<RunSignals> recorded;
  for (const GoldenLog& log : set.logs) {
    if (log.expected.verdict != to_string(Verdict::healthy)) continue;
    if (!log.damage.empty()) throw Error(ErrorCode::input, log.log.path, log.damage);
    const auto source = open_robot_log(arguments.folder + "/" + log.log.path, model.robot);
    recorded.push_back(read_run(*source, &model).signals);
    recorded.back().name = log.name();
  }
  if (recorded.empty())
    throw Error(ErrorCode::usage, arguments.folder,
                "has no healthy run; record logs of healthy runs with faultline golden record");
  const std::string widened = arguments.folder + "/runs.toml";
  const auto tolerances = has_inner_file(arguments.folder, widened)
                              ? widened_tolerances(read_inner_file(arguments.folder, widened), widened)
                              : std::vector<WidenedTolerance>{};
  std::vector<NewRunCheck> runs;
  for (const std::string& log : arguments.logs) {
    const auto source = open_robot_log(log, model.robot);
    runs.push_back(check_new_run(read_run(*source, &model).signals, recorded, tolerances, turns_of(model)));
  }
  return runs;
}

}  // namespace faultline
