// SPDX-License-Identifier: MIT
#include "apps/work/history_results.hpp"

#include <algorithm>
#include <filesystem>

#include "lib/core/atomic_file.hpp"
#include "lib/core/error.hpp"

namespace faultline {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostDiagnosisBytes = std::size_t{64} << 20;  // of a diagnosis

/// Returns the JSON files below a folder, sorted.
std::vector<std::string> json_files(const std::string& folder) {
  std::vector<std::string> files;
  std::error_code error;
  for (fs::recursive_directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    const std::string name = at->path().filename().string();
    const auto status = at->symlink_status(error);
    if (fs::is_directory(status) && name.starts_with(".")) at.disable_recursion_pending();
    if (fs::is_regular_file(status) && !name.starts_with(".") && at->path().extension() == ".json")
      files.push_back(at->path().string());
  }
  if (error) throw Error(ErrorCode::input, folder, "cannot be searched (" + error.message() + ")");
  std::sort(files.begin(), files.end());
  return files;
}

void add_below(std::vector<HistoryRecord>& records, const std::string& folder) {
  const std::size_t before = records.size();
  for (const std::string& file : json_files(folder))
    if (const std::string text = read_file(file, kMostDiagnosisBytes); is_diagnosis_json(text))
      records.push_back(history_record(text, file));
  if (records.size() == before)
    throw Error(ErrorCode::input, folder,
                "contains no diagnosis; give the folders that faultline batch wrote, or files of faultline "
                "diagnose --json");
}

}  // namespace

std::vector<HistoryRecord> history_results(const std::vector<std::string>& paths) {
  std::vector<HistoryRecord> records;
  for (const std::string& path : paths) {
    std::error_code ignored;
    const fs::path given(path), name = given.filename();
    if (fs::is_directory(given, ignored))
      add_below(records, path);
    else if (name == "index.ndjson" || name == "summary.json")
      add_below(records, given.has_parent_path() ? given.parent_path().string() : ".");
    else
      records.push_back(history_record(read_file(path, kMostDiagnosisBytes), path));
  }
  return records;
}

}  // namespace faultline
