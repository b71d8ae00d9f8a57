// SPDX-License-Identifier: MIT
#include "lib/batch/find_logs.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>

#include "lib/batch/batch_folder.hpp"
#include "lib/core/error.hpp"

namespace faultline {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kTableOfLogs = "file,";  // labels files, reports as CSV, index.csv

std::string lower_name(const fs::path& path) {
  std::string text = path.filename().string();
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

bool starts_as_table_of_logs(const fs::path& path) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return false;
  std::ifstream file(path, std::ios::binary);
  std::string head(kTableOfLogs.size(), '\0');
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  return file && head == kTableOfLogs;
}

class Finder {
 public:
  explicit Finder(const std::vector<std::string>& endings) : endings_(endings) {}

  void take(const std::string& given) {
    std::error_code error;
    const fs::path path(given);
    if (fs::is_directory(path, error)) {
      const fs::path whole = fs::absolute(path, error).lexically_normal();
      const fs::path own = whole.has_filename() ? whole.filename() : whole.parent_path().filename();
      take_folder(path, own.generic_string());
    } else if (fs::exists(path, error)) {
      add(path, path.filename().generic_string());
    } else {
      throw Error(ErrorCode::input, given, "does not exist; give files or folders of logs");
    }
  }

  std::vector<BatchLog> sorted() const {
    std::vector<BatchLog> logs;
    for (const auto& [file, log] : found_) logs.push_back(log);
    std::sort(logs.begin(), logs.end(), [](const BatchLog& a, const BatchLog& b) {
      return a.name != b.name ? a.name < b.name : a.path < b.path;
    });
    return logs;
  }

 private:
  void take_folder(const fs::path& folder, const std::string& name) {
    std::error_code error;
    if (is_batch_folder(folder.string())) return;
    fs::directory_iterator entry(folder, error);
    if (error) return add(folder, name);
    for (const fs::directory_iterator end; entry != end; entry.increment(error)) {
      const std::string own = entry->path().filename().generic_string();
      const std::string below = name.empty() ? own : name + "/" + own;
      if (own.starts_with(".")) continue;
      if (entry->is_directory(error) && !entry->is_symlink(error))
        take_folder(entry->path(), below);
      else if (is_log(*entry))
        add(entry->path(), below);
    }
  }

  bool is_log(const fs::directory_entry& entry) const {
    const std::string name = lower_name(entry.path());
    if (std::none_of(endings_.begin(), endings_.end(),
                     [&](const std::string& ending) { return name.ends_with(ending); }))
      return false;
    std::error_code error;
    return !entry.is_directory(error) && !starts_as_table_of_logs(entry.path());
  }

  /// A file reached by two of the given paths is one log, under the name that sorts first.
  void add(const fs::path& path, const std::string& name) {
    std::error_code error;
    const std::string file = fs::weakly_canonical(path, error).string();
    const BatchLog log{path.string(), name, 0};
    const auto [place, fresh] = found_.try_emplace(error ? path.string() : file, log);
    if (!fresh && name < place->second.name) place->second = log;
  }

  const std::vector<std::string>& endings_;
  std::map<std::string, BatchLog> found_;
};

}  // namespace

std::vector<BatchLog> find_logs(const std::vector<std::string>& paths,
                                const std::vector<std::string>& endings) {
  Finder finder(endings);
  for (const std::string& path : paths) finder.take(path);
  return finder.sorted();
}

}  // namespace faultline
