// SPDX-License-Identifier: MIT
#include <sys/stat.h>

#include <array>
#include <cstdlib>
#include <filesystem>

#include "lib/cases/sqlite.hpp"
#include "lib/core/error.hpp"

namespace faultline {
namespace {

namespace fs = std::filesystem;

constexpr std::array<const char*, 2> kJournals = {"-journal", "-wal"};

/// Returns a text that changes if the file changes; empty if there is no file.
std::string state_of(const std::string& path) {
  struct stat found {};
  if (::stat(path.c_str(), &found) != 0) return "";
  std::string state;
  for (const long long part :
       {static_cast<long long>(found.st_ino), static_cast<long long>(found.st_size),
        static_cast<long long>(found.st_mtim.tv_sec), static_cast<long long>(found.st_mtim.tv_nsec)})
    state += std::to_string(part) + " ";
  return state;
}

std::string state_of_all(const std::string& path) {
  std::string state = state_of(path);
  for (const char* journal : kJournals) state += "/" + state_of(path + journal);
  return state;
}

std::string private_folder(const std::string& path) {
  std::error_code error;
  std::string name = (fs::temp_directory_path(error) / "faultline-cases-XXXXXX").string();
  if (error || !::mkdtemp(name.data()))
    throw Error(
        ErrorCode::input, path,
        "holds a change that was interrupted, and there is no folder for temporary files to undo it "
        "in; set TMPDIR to one, or undo it in place with `faultline cases confirm`, `reject` or `add`");
  return name;
}

/// Copies a file without its permissions, which may forbid writing. Returns the reason of a failure, or "".
std::string copy_bytes(const std::string& from, const std::string& to) {
  std::error_code error, ignored;
  fs::copy_file(from, to, error);
  fs::permissions(to, fs::perms::owner_read | fs::perms::owner_write, ignored);
  return error ? error.message() : "";
}

/// Copies the file and the existing journals, as copy_bytes().
std::string copy_all(const std::string& from, const std::string& to) {
  std::string failure = copy_bytes(from, to);
  for (const char* journal : kJournals)
    if (failure.empty() && !state_of(from + journal).empty())
      failure = copy_bytes(from + journal, to + journal);
  return failure;
}

}  // namespace

bool has_journal(const std::string& path) {
  std::error_code error;
  for (const char* journal : kJournals)
    if (fs::exists(path + journal, error)) return true;
  return false;
}

void remove_journals(const std::string& path) {
  std::error_code error;
  for (const std::string& file : sqlite_files(path))
    if (file != path) fs::remove(file, error);
}

SettledCopy::SettledCopy(const std::string& path) : folder_(private_folder(path)) {
  const std::string before = state_of_all(path), failure = copy_all(path, this->path());
  of_one_moment_ = state_of_all(path) == before;
  if (failure.empty() || !of_one_moment_) return;
  std::error_code error;
  fs::remove_all(folder_, error);
  throw Error(ErrorCode::input, path,
              "holds a change that was interrupted and cannot be copied to undo it (" + failure + ")");
}

SettledCopy::~SettledCopy() {
  std::error_code error;
  fs::remove_all(folder_, error);
}

}  // namespace faultline
