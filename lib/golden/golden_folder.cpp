// SPDX-License-Identifier: MIT
#include "lib/golden/golden_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <set>

#include "lib/cases/case_file.hpp"
#include "lib/cases/sqlite.hpp"
#include "lib/core/atomic_file.hpp"
#include "lib/core/error.hpp"
#include "lib/core/files/inner_file.hpp"
#include "lib/core/hash.hpp"

namespace faultline {
namespace {

namespace fs = std::filesystem;

constexpr const char* kGoldenToml = "golden.toml";

std::string inside(const std::string& folder, const std::string& path) {
  return (fs::path(folder) / path).string();
}

/// What is wrong with the file; empty when it is the one that was recorded.
std::string damage_of(const std::string& folder, const GoldenFile& file) {
  try {
    if (sha256_of_file(inside(folder, file.path)) == file.sha256) return "";
    return file.path + " is not the file that was recorded (another SHA-256): restore it";
  } catch (const Error& error) {
    return file.path + " " + error.message();
  }
}

void read_trace(const std::string& folder, GoldenLog& log) {
  log.damage = damage_of(folder, log.log);
  if (log.damage.empty()) log.damage = damage_of(folder, log.trace);
  if (!log.damage.empty()) return;
  const std::string path = inside(folder, log.trace.path);
  log.expected.trace = trace_from_csv(read_file(path), path);
}

std::string short_hash(const std::string& sha256) { return sha256.substr(0, 8); }

/// Throws Error(input) unless all that `set` names, and the journals that SQLite would read beside it, are
/// regular files in the folder or missing: before anything of it is opened.
void refuse_foreign_files(const std::string& folder, const GoldenSet& set) {
  for (const std::string& path : set.files())
    for (const std::string& file : sqlite_files(path)) has_inner_file(folder, file);
}

/// Whether a file's name ends with a part of the hash of what it holds, as this program names it.
bool is_named_by_content(const fs::path& file) {
  static const std::regex pattern(R"((model|cases|.+)-([0-9a-f]{8})\.(json|db|csv))");
  const std::string name = file.filename().string();
  std::smatch parts;
  if (!std::regex_match(name, parts, pattern)) return false;
  const std::string hash =
      parts[3] == "db" ? read_case_base(file.string()).sha256() : sha256_of_file(file.string());
  return short_hash(hash) == parts[2];
}

void write_trace(const std::string& folder, GoldenLog& log) {
  const std::string text = trace_to_csv(log.expected.trace);
  log.trace.sha256 = sha256_hex(text);
  log.trace.path =
      fmt::format("traces/{}-{}.csv", fs::path(log.name()).stem().string(), short_hash(log.trace.sha256));
  if (!damage_of(folder, log.trace).empty()) write_inner_file(folder, log.trace.path, text);
}

}  // namespace

std::string golden_file(const std::string& folder) { return inside(folder, kGoldenToml); }

GoldenSet load_golden(const std::string& folder) {
  if (fs::is_directory(folder) && !fs::exists(golden_file(folder)))
    throw Error(
        ErrorCode::input, folder,
        "has no golden.toml; make a golden folder with: faultline golden record LOG... --model MODEL -o DIR");
  GoldenSet set = golden_from_text(read_inner_file(folder, kGoldenToml), golden_file(folder));
  refuse_foreign_files(folder, set);
  for (GoldenLog& log : set.logs) read_trace(folder, log);
  return set;
}

ModelAndCases load_model_and_cases(const std::string& model, const std::string& cases) {
  return {load_model_files(model, cases), fs::path(model).filename().string()};
}

ModelAndCases load_golden_model(const std::string& folder, const GoldenSet& set) {
  if (const std::string damage = damage_of(folder, set.model); !damage.empty())
    throw Error(ErrorCode::input, folder, damage);
  ModelAndCases subject =
      load_model_and_cases(inside(folder, set.model.path), inside(folder, set.cases.path));
  if (subject.cases.sha256() != set.cases.sha256)
    throw Error(ErrorCode::input, inside(folder, set.cases.path),
                "is not the case base that was recorded (another content hash): restore it");
  subject.name = set.model_name;
  return subject;
}

std::vector<ReplayLog> replay_logs(const std::string& folder, const GoldenSet& set) {
  std::vector<ReplayLog> logs;
  for (const GoldenLog& log : set.logs) {
    const bool identify = set.identification && std::count(set.identification->logs.begin(),
                                                           set.identification->logs.end(), log.name());
    logs.push_back({log.name(), inside(folder, log.log.path), identify});
  }
  return logs;
}

void save_golden(const std::string& folder, GoldenSet& set, const std::vector<std::string>& outdated) {
  for (GoldenLog& log : set.logs)
    if (log.damage.empty()) write_trace(folder, log);
  write_inner_file(folder, kGoldenToml, golden_text(set));
  const std::vector<std::string> named = set.files();
  std::error_code error;
  for (const std::string& path : outdated)
    if (!std::count(named.begin(), named.end(), path) && has_inner_file(folder, path))
      fs::remove(inside(folder, path), error);
}

void remove_orphaned_files(const std::string& folder, const GoldenSet& set) {
  std::set<fs::path> named;
  for (const std::string& path : set.files()) named.insert(inside(folder, path));
  for (const std::string& part : {folder, inside(folder, "traces")}) {
    std::error_code error;
    if (part != folder && !fs::is_directory(fs::symlink_status(part, error))) continue;
    for (const auto& entry : fs::directory_iterator(part, error)) {
      try {
        if (fs::is_regular_file(entry.symlink_status(error)) && !named.count(entry.path()) &&
            is_named_by_content(entry.path()))
          fs::remove(entry.path(), error);
      } catch (const Error&) {
        // a file that cannot be read is not ours to remove
      }
    }
  }
}

GoldenSet adopt_model(const std::string& folder, const std::string& model, const ModelAndCases& subject,
                      GoldenSet set) {
  set.model_name = subject.name;
  set.joints = subject.model.robot.joints();
  set.model = {fmt::format("model-{}.json", short_hash(subject.model.sha256)), subject.model.sha256};
  set.cases = {fmt::format("cases-{}.db", short_hash(subject.cases.sha256())), subject.cases.sha256()};
  write_inner_file(folder, set.model.path, read_file(model));
  for (const std::string& file : sqlite_files(set.cases.path)) prepare_inner_file(folder, file);
  write_case_base(inside(folder, set.cases.path), subject.cases);
  return set;
}

}  // namespace faultline
