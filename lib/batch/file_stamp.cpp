// SPDX-License-Identifier: MIT
#include "lib/batch/file_stamp.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <ctime>

namespace faultline {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr std::int64_t kCoarsest_ns = 2 * kSecond_ns;  // FAT has the coarsest clock

std::int64_t nanoseconds(const timespec& time) { return time.tv_sec * kSecond_ns + time.tv_nsec; }

}  // namespace

FileStamp stamp_of(const std::string& path) {
  struct stat facts {};
  if (::stat(path.c_str(), &facts) != 0) return {};
  return {facts.st_size, nanoseconds(facts.st_mtim), nanoseconds(facts.st_ctim),
          static_cast<std::int64_t>(facts.st_ino)};
}

std::vector<FileStamp> stamps_of(const std::vector<std::string>& paths) {
  std::vector<FileStamp> stamps;
  for (const std::string& path : paths) stamps.push_back(stamp_of(path));
  return stamps;
}

bool are_settled(const std::vector<FileStamp>& stamps) {
  timespec now{};
  ::clock_gettime(CLOCK_REALTIME, &now);
  return std::all_of(stamps.begin(), stamps.end(), [&](const FileStamp& stamp) {
    return std::max(stamp.written_ns, stamp.changed_ns) < nanoseconds(now) - kCoarsest_ns;
  });
}

}  // namespace faultline
