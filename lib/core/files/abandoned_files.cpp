// SPDX-License-Identifier: MIT
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <ctime>
#include <filesystem>
#include <mutex>
#include <set>

#include "lib/core/files/output_place.hpp"
#include "lib/core/files/temporary_file.hpp"
#include "lib/core/files/temporary_name.hpp"

namespace faultline {
namespace {

namespace fs = std::filesystem;

constexpr std::time_t kLongUntouched_s = 24 * 3600;  // a running program writes more often

bool is_untouched(const struct stat& facts) { return std::time(nullptr) - facts.st_mtime > kLongUntouched_s; }

/// Whether the program that created the open file, which has no lock, cannot be running.
bool is_abandoned(const fs::path& path, const struct stat& facts) {
  switch (temporary_kind(path.filename().string())) {
    case TemporaryKind::none:
      return false;
    case TemporaryKind::this_machine:
      return true;
    case TemporaryKind::other_machine:
      return is_untouched(facts);
  }
  return false;
}

void remove_if_abandoned(const fs::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) return;
  struct stat facts {
  }, named{};
  const bool free = ::flock(descriptor, LOCK_EX | LOCK_NB) == 0;
  if (free && ::fstat(descriptor, &facts) == 0 && S_ISREG(facts.st_mode) && is_abandoned(path, facts) &&
      ::lstat(path.c_str(), &named) == 0 && named.st_ino == facts.st_ino && named.st_dev == facts.st_dev)
    ::unlink(path.c_str());
  ::close(descriptor);
}

/// Returns true once for each folder.
bool is_new(const std::string& folder) {
  static std::mutex mutex;
  static std::set<std::string> known;
  const std::lock_guard lock(mutex);
  return known.insert(real_path(folder)).second;
}

}  // namespace

void remove_abandoned_files(const std::string& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error) || !is_new(folder)) return;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
    if (is_temporary_name(entry->path().filename().string())) remove_if_abandoned(entry->path());
}

}  // namespace faultline
