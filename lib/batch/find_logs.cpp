// SPDX-License-Identifier: MIT
#include "lib/batch/find_logs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>

#include "lib/batch/batch_folder.hpp"
#include "lib/core/error.hpp"
#include "lib/core/text.hpp"

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

using Parts = std::vector<std::string>;

Parts parts_of(const fs::path& path) {
  Parts parts;
  for (const fs::path& part : path.lexically_normal())
    if (!part.empty() && part != ".") parts.push_back(part.generic_string());
  return parts;
}

Parts real_parts(const std::string& path) {
  std::error_code error;
  return parts_of(fs::weakly_canonical(path, error));
}

struct Choice {
  int model = 0;
  Parts named;  ///< as it was given
  Parts real;   ///< where it is; empty when there is none here
};

/// How deep in the log's path the folder ends, counted from the log: 1 is its own folder; 0 when the log is
/// not in it.
std::size_t steps_up(const Parts& log, const Parts& folder) {
  if (folder.empty() || log.size() <= folder.size()) return 0;
  for (std::size_t end = log.size() - 1; end >= folder.size(); --end)
    if (std::equal(folder.begin(), folder.end(),
                   log.begin() + static_cast<std::ptrdiff_t>(end - folder.size())))
      return log.size() - end;
  return 0;
}

std::size_t steps_below(const Parts& log, const Parts& folder) {
  const bool inside =
      !folder.empty() && log.size() > folder.size() && std::equal(folder.begin(), folder.end(), log.begin());
  return inside ? log.size() - folder.size() : 0;
}

std::size_t steps_to(const Choice& choice, const Parts& name, const Parts& real) {
  const std::size_t here = steps_below(real, choice.real);
  return here > 0 ? here : steps_up(name, choice.named);
}

std::vector<Choice> choices_of(const std::vector<std::string>& folders) {
  std::vector<Choice> choices;
  for (int i = 0; i < std::ssize(folders); ++i) {
    const std::string& folder = folders[static_cast<std::size_t>(i)];
    std::error_code error;
    if (folder.empty()) continue;
    choices.push_back({i, parts_of(folder), fs::is_directory(folder, error) ? real_parts(folder) : Parts{}});
  }
  return choices;
}

void refuse_twice(const std::vector<std::string>& folders) {
  std::set<Parts> seen;
  for (const std::string& folder : folders)
    if (!seen.insert(parts_of(folder)).second)
      throw Error(ErrorCode::usage, "--model",
                  folder.empty()
                      ? "is given twice without a folder; give --model DIR=MODEL for the logs below DIR"
                      : "is given twice for folder " + folder + "; give one model per folder");
}

}  // namespace

std::vector<BatchLog> find_logs(const std::vector<std::string>& paths,
                                const std::vector<std::string>& endings) {
  Finder finder(endings);
  for (const std::string& path : paths) finder.take(path);
  return finder.sorted();
}

std::vector<BatchLog> with_models(std::vector<BatchLog> logs, const std::vector<std::string>& folders) {
  refuse_twice(folders);
  const std::vector<Choice> choices = choices_of(folders);
  const auto rest = std::find(folders.begin(), folders.end(), "");
  std::vector<bool> used(folders.size());
  std::string first_without;
  std::size_t without = 0;
  for (BatchLog& log : logs) {
    const Parts name = parts_of(log.name), real = choices.empty() ? Parts{} : real_parts(log.path);
    const Choice* nearest = nullptr;
    std::size_t least = 0;
    for (const Choice& choice : choices) {
      const std::size_t steps = steps_to(choice, name, real);
      if (steps == 0) continue;
      used[static_cast<std::size_t>(choice.model)] = true;
      const bool nearer =
          !nearest || steps < least || (steps == least && choice.named.size() > nearest->named.size());
      if (nearer) nearest = &choice, least = steps;
    }
    log.model = nearest ? nearest->model : static_cast<int>(rest - folders.begin());
    if (nearest || rest != folders.end()) continue;
    if (without++ == 0) first_without = log.name;
  }
  for (const Choice& choice : choices)
    if (!used[static_cast<std::size_t>(choice.model)] && choice.real.empty())
      throw Error(ErrorCode::usage, "--model " + folders[static_cast<std::size_t>(choice.model)] + "=...",
                  "no log is below a folder of that name; logs have names such as " +
                      (logs.empty() ? std::string("runs/a.csv") : logs.front().name));
  if (without > 0)
    throw Error(ErrorCode::usage, first_without,
                fmt::format("{} of {} have no model, this is the first one; add --model DIR=MODEL for its "
                            "folder, or --model MODEL for all logs without a model of their own",
                            without, counted(static_cast<int>(logs.size()), "log")));
  return logs;
}

}  // namespace faultline
