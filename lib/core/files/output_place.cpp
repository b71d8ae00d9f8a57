// SPDX-License-Identifier: MIT
#include "lib/core/files/output_place.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>

#include "lib/core/error.hpp"

namespace faultline {
namespace {

namespace fs = std::filesystem;

constexpr int kMostLinks = 40;

/// Returns the folder that contains `path`.
fs::path folder_of(const fs::path& path) {
  const fs::path parent = path.parent_path();
  return parent.empty() ? fs::path(".") : parent;
}

/// Returns N of /proc/self/fd/N, also if links lead to its folder; -1 for other paths.
int own_descriptor(const fs::path& path) {
  const std::string name = path.filename().string();
  int number = -1;
  const auto [end, failure] = std::from_chars(name.data(), name.data() + name.size(), number);
  if (failure != std::errc() || end != name.data() + name.size()) return -1;
  std::error_code error;
  const std::string descriptors = "/proc/" + std::to_string(::getpid()) + "/fd";
  return fs::canonical(folder_of(path), error) == descriptors ? number : -1;
}

[[noreturn]] void refuse(const std::string& path, int reason) {
  throw Error(ErrorCode::output, path,
              std::string("is a symbolic link that cannot be followed (") + std::strerror(reason) +
                  "); give another name");
}

std::string identity(const struct stat& facts) {
  return std::to_string(facts.st_dev) + ":" + std::to_string(facts.st_ino);
}

bool is_known_by_several(const struct stat& facts) { return S_ISREG(facts.st_mode) && facts.st_nlink > 1; }

}  // namespace

OutputPlace output_place(const std::string& path) {
  struct stat facts {};
  const bool exists = ::stat(path.c_str(), &facts) == 0;
  const int reason = errno;
  OutputPlace place{path};
  std::error_code error;
  for (int links = 0;; ++links) {
    place.descriptor = own_descriptor(place.path);
    if (place.descriptor >= 0) break;
    if (!fs::is_symlink(fs::symlink_status(place.path, error))) break;
    if (!exists && reason != ENOENT) refuse(path, reason);
    if (links == kMostLinks) refuse(path, ELOOP);
    const fs::path target = fs::read_symlink(place.path, error);
    if (error) refuse(path, error.value());
    place.path = (target.is_absolute() ? target : folder_of(place.path) / target).string();
  }
  place.special = place.descriptor >= 0 || (exists && !S_ISREG(facts.st_mode) && !S_ISDIR(facts.st_mode));
  return place;
}

std::string file_identity(const std::string& path) {
  const OutputPlace place = output_place(path);
  if (place.special) return "";
  std::string rest;
  struct stat facts {};
  for (fs::path at = place.path;;) {
    if (::stat(at.c_str(), &facts) == 0) return identity(facts) + rest;
    const fs::path above = folder_of(at);
    if (above == at) return rest;
    if (at.has_filename()) rest = "/" + at.filename().string() + rest;
    at = above;
  }
}

std::string real_path(const std::string& path) {
  std::error_code error;
  const fs::path real = fs::weakly_canonical(fs::absolute(output_place(path).path, error), error);
  return (real.has_filename() ? real : real.parent_path()).string();
}

bool has_other_names(int descriptor) {
  struct stat facts {};
  return ::fstat(descriptor, &facts) == 0 && is_known_by_several(facts);
}

void refuse_other_names(const std::string& path) {
  struct stat facts {};
  if (::stat(path.c_str(), &facts) == 0 && is_known_by_several(facts))
    throw Error(ErrorCode::output, path,
                "has another name as well (a hard link), and writing here would change that file, too; "
                "nothing was changed. Replace it by a copy of the file");
}

}  // namespace faultline
