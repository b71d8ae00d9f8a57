// SPDX-License-Identifier: MIT
#include "apps/work/golden_work.hpp"

#include <algorithm>
#include <filesystem>
#include <set>

#include "apps/work/file_use.hpp"
#include "apps/work/folder.hpp"
#include "apps/work/labels.hpp"
#include "apps/work/robot_log.hpp"
#include "lib/core/atomic_file.hpp"
#include "lib/core/error.hpp"
#include "lib/core/files/output_place.hpp"
#include "lib/golden/check_text.hpp"
#include "lib/golden/golden_folder.hpp"
#include "lib/golden/run_json.hpp"

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

/// Returns the folder's own name, without its path on this machine.
std::string suite_name(const std::string& folder) {
  const std::filesystem::path path = std::filesystem::weakly_canonical(folder);
  return path.has_filename() ? path.filename().string() : path.parent_path().filename().string();
}

}  // namespace

std::unique_ptr<LogSource> open_golden_log(const std::string& path, const Model& model) {
  return open_robot_log(path, model.robot);
}

ModelAndCases golden_subject(const GoldenArguments& arguments, const GoldenSet& set) {
  return arguments.model.empty() ? load_golden_model(arguments.folder, set)
                                 : load_model_and_cases(arguments.model, arguments.case_base());
}

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

}  // namespace faultline
