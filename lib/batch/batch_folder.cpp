// SPDX-License-Identifier: MIT
#include "lib/batch/batch_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <regex>
#include <vector>

#include "lib/core/error.hpp"
#include "lib/core/files/inner_file.hpp"
#include "lib/core/files/temporary_file.hpp"

namespace faultline {
namespace {

namespace fs = std::filesystem;

void make(const std::string& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error || !fs::is_directory(folder))
    throw Error(ErrorCode::output, folder,
                "cannot be made into a folder for the results" +
                    (error ? " (" + error.message() + ")" : std::string()) + "; give another with -o");
}

std::vector<fs::path> files_in(const std::string& folder) {
  std::error_code error;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder, error)) files.push_back(entry.path());
  return files;
}

bool is_result(const fs::path& file) {
  static const std::regex pattern(R"([A-Za-z0-9._-]*-[0-9a-f]{12}\.(json|html))");
  return std::regex_match(file.filename().string(), pattern);
}

void remove_file(const fs::path& file) {
  std::error_code error;
  if (!fs::remove(file, error) && error)
    throw Error(ErrorCode::output, file.string(),
                "of an earlier run cannot be removed (" + error.message() + ")");
}

/// As fail_to_write(), by the present errno.
[[noreturn]] void close_and_fail(int file, const std::string& path, const char* doing) {
  const int reason = errno;
  ::close(file);
  errno = reason;
  fail_to_write(path, doing);
}

}  // namespace

bool BatchFolder::has(const std::string& name) const { return has_inner_file(path_, name); }

std::string BatchFolder::read(const std::string& name) const { return read_inner_file(path_, name); }

void BatchFolder::write(const std::string& name, std::string_view bytes) const {
  write_inner_file(path_, name, bytes);
}

void BatchFolder::write_unsynced(const std::string& name, std::string_view bytes) const {
  const std::string path = file(name);
  prepare_inner_file(path_, name);
  ::unlink(path.c_str());  // other names of a hard link keep their content
  const int out = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (out < 0) fail_to_write(path, "created");
  while (!bytes.empty()) {
    const ssize_t written = ::write(out, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) close_and_fail(out, path, "written");
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  if (::close(out) != 0) fail_to_write(path, "written");
}

void BatchFolder::sync() const {
  const int folder = ::open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder < 0) fail_to_write(path_, "opened");
  if (::syncfs(folder) != 0) close_and_fail(folder, path_, "brought to the disk");
  ::close(folder);
}

bool is_batch_folder(const std::string& folder) {
  std::error_code error;
  return fs::is_directory(folder + "/.batch", error);
}

BatchFolder::BatchFolder(std::string folder, bool wait) : path_(std::move(folder)) {
  std::error_code error;
  if (fs::is_directory(path_, error) && !fs::is_empty(path_, error) && !error && !is_batch_folder(path_))
    throw Error(ErrorCode::usage, path_,
                "holds other files than results of a batch; give a new folder with -o");
  refuse_foreign_places();
  make(path_ + "/.batch");
  lock(wait);
  make(path_ + "/logs");
}

BatchFolder::~BatchFolder() { ::close(lock_); }

void BatchFolder::refuse_foreign_places() const {
  for (const char* folder : {".batch", "logs"}) has_inner_folder(path_, folder);
  for (const char* name : {".batch/lock", ".batch/journal", ".batch/known_logs", ".batch/finished.json",
                           "index.csv", "index.ndjson", "index.html", "summary.json", "faultline_mqc.json"})
    has_inner_file(path_, name);
}

void BatchFolder::lock(bool wait) {
  const std::string name = path_ + "/.batch/lock";
  lock_ = ::open(name.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (lock_ < 0)
    throw Error(ErrorCode::output, path_,
                std::string("cannot be written to (") + std::strerror(errno) +
                    "); check its permissions or choose another folder with -o");
  int status;
  do status = ::flock(lock_, wait ? LOCK_EX : LOCK_EX | LOCK_NB);
  while (status != 0 && errno == EINTR);
  if (status == 0 || errno != EWOULDBLOCK) return;  // a file system without locks: temporary names differ
  ::close(lock_);
  throw Error(ErrorCode::output, path_,
              "another batch is writing to this folder; wait for its end (--wait does) or choose another "
              "folder with -o");
}

void BatchFolder::mark_unfinished() const { remove_file(finished()); }

void BatchFolder::clean(const std::set<std::string>& results) const {
  for (const char* part : {"", ".batch", "logs"})
    for (const fs::path& file : files_in(file(part)))
      if (is_temporary_name(file.filename().string())) remove_file(file);
  for (const fs::path& file : files_in(file("logs")))
    if (is_result(file) && !results.count(file.filename().string())) remove_file(file);
}

}  // namespace faultline
