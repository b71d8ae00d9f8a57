// SPDX-License-Identifier: MIT
#include "lib/core/files/temporary_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <limits.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <mutex>
#include <random>
#include <set>

#include "lib/core/error.hpp"
#include "lib/core/files/output_place.hpp"
#include "lib/core/files/removed_on_signal.hpp"
#include "lib/core/hash.hpp"

namespace faultline {
namespace {

namespace fs = std::filesystem;

constexpr int kTries = 100;
constexpr mode_t kPermissions = 0777;

std::string folder_of(const std::string& path) {
  const std::string folder = fs::path(path).parent_path().string();
  return folder.empty() ? "." : folder;
}

/// Ensures that the name in the folder is on the disk, too, if the file system supports that.
void sync_folder(const std::string& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

constexpr std::time_t kLongUntouched_s = 24 * 3600;  // a running program writes more often

/// Whether the program that created the open file, which has no lock, cannot be running.
bool is_abandoned(const fs::path& path, const struct stat& facts) {
  switch (temporary_kind(path.filename().string())) {
    case TemporaryKind::none:
      return false;
    case TemporaryKind::this_machine:
      return true;
    case TemporaryKind::other_machine:
      return std::time(nullptr) - facts.st_mtime > kLongUntouched_s;
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

constexpr std::string_view kMark = ".partial-";
constexpr std::size_t kMachineDigits = 8, kRandomDigits = 16;
constexpr std::size_t kTail = kMark.size() + kMachineDigits + kRandomDigits;

const std::string& machine() {
  static const std::string digits = [] {
    std::array<char, HOST_NAME_MAX + 1> name{};
    ::gethostname(name.data(), name.size() - 1);
    return sha256_hex(name.data()).substr(0, kMachineDigits);
  }();
  return digits;
}

std::uint64_t random_number() {
  thread_local std::random_device entropy;
  return std::uint64_t{entropy()} << 32 | entropy();
}

bool is_hexadecimal(std::string_view text) {
  return std::all_of(text.begin(), text.end(),
                     [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); });
}

/// Returns the text behind the mark; empty without one.
std::string_view tail_of(std::string_view name) {
  const auto mark = name.rfind(kMark);
  return mark == std::string_view::npos ? std::string_view() : name.substr(mark + kMark.size());
}

}  // namespace

void fail_to_write(const std::string& path, const char* doing) {
  const std::string reason = std::strerror(errno);
  wait_if_ending();
  throw Error(
      ErrorCode::output, path,
      std::string("cannot be ") + doing + " (" + reason +
          "); nothing was changed under that name. Check that the folder exists, is writable and has room");
}

TemporaryFile::TemporaryFile(std::string target) : target_(std::move(target)) {
  place_ = output_place(target_).path;
  remove_abandoned_files(folder_of(place_));
  struct stat there {};
  const bool exists = ::stat(place_.c_str(), &there) == 0;
  errno = exists && S_ISDIR(there.st_mode) ? EISDIR : 0;
  if (errno != 0) fail("created");
  if (exists && ::faccessat(AT_FDCWD, place_.c_str(), W_OK, AT_EACCESS) != 0) fail("replaced");
  for (int tries = 0; !create(); ++tries)
    if (errno != EEXIST || tries == kTries) fail("created");
  if (exists) take_over_mode();
}

/// Returns false with errno EEXIST if another try may succeed.
bool TemporaryFile::create() {
  path_ = temporary_name(place_);
  {
    const HeldSignals signals;
    on_signal_ = std::make_unique<RemovedOnSignal>(path_);
    descriptor_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
  }
  if (descriptor_ < 0) {
    const int reason = errno;
    on_signal_.reset();
    path_.clear();
    errno = reason;
    return false;
  }
  struct stat facts {};
  const bool locked = ::flock(descriptor_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
  if (locked && ::fstat(descriptor_, &facts) == 0 && facts.st_nlink > 0) return true;
  remove();  // another program removed it as abandoned before it was locked
  errno = EEXIST;
  return false;
}

void TemporaryFile::take_over_mode() {
  struct stat there {};
  if (::stat(place_.c_str(), &there) != 0) return;
  if (::fchown(descriptor_, there.st_uid, there.st_gid) != 0) errno = 0;  // only root may change the owner
  if (::fchmod(descriptor_, there.st_mode & kPermissions) != 0) fail("given the mode it had");
}

void TemporaryFile::remove() {
  if (!path_.empty()) ::unlink(path_.c_str());
  path_.clear();
  on_signal_.reset();
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = -1;
}

TemporaryFile::~TemporaryFile() { remove(); }

void TemporaryFile::fail(const char* doing) {
  const int reason = errno;
  remove();
  errno = reason;
  fail_to_write(target_, doing);
}

void TemporaryFile::commit() {
  if (::fsync(descriptor_) != 0 && errno != EINVAL) fail("written");
  if (std::rename(path_.c_str(), place_.c_str()) != 0) fail("renamed into place");
  path_.clear();
  on_signal_.reset();
  const int closed = ::close(descriptor_);
  descriptor_ = -1;
  sync_folder(folder_of(place_));
  if (closed != 0) fail("written");
}

void remove_abandoned_files(const std::string& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error) || !is_new(folder)) return;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
    if (is_temporary_name(entry->path().filename().string())) remove_if_abandoned(entry->path());
}

std::string temporary_name(const std::string& path) {
  const std::filesystem::path place(path);
  const std::string name = place.filename().string().substr(0, NAME_MAX - kTail);
  return (place.parent_path() / fmt::format("{}{}{}{:016x}", name, kMark, machine(), random_number()))
      .string();
}

TemporaryKind temporary_kind(std::string_view name) {
  const std::string_view tail = tail_of(name);
  if (tail.size() != kMachineDigits + kRandomDigits || !is_hexadecimal(tail)) return TemporaryKind::none;
  return tail.substr(0, kMachineDigits) == machine() ? TemporaryKind::this_machine
                                                     : TemporaryKind::other_machine;
}

bool is_temporary_name(std::string_view name) { return temporary_kind(name) != TemporaryKind::none; }

}  // namespace faultline
