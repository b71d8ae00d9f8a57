// SPDX-License-Identifier: MIT
#include "formats/bytes/file_bytes.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "lib/core/error.hpp"

namespace faultline {
namespace {

constexpr std::size_t kBytesHeadBytes = 1 << 16;

[[noreturn]] void fail_file(const std::string& path, const std::string& what) {
  throw Error(ErrorCode::input, path, what);
}

std::string reason() { return std::strerror(errno); }

}  // namespace

FileBytes::FileBytes(std::string path, bool hashed) : path_(std::move(path)) {
  if (hashed) hash_.emplace();
  open();
  try {
    read_head(kBytesHeadBytes);
  } catch (...) {
    close();
    throw;
  }
  if (regular_) close();
}

FileBytes::~FileBytes() { close(); }

void FileBytes::open() {
  file_ = ::open(path_.c_str(), O_RDONLY | O_CLOEXEC);
  if (file_ < 0 && errno == ENOENT) fail_file(path_, "no such file; check the path");
  if (file_ < 0) fail_file(path_, "cannot be opened for reading (" + reason() + ")");
  struct stat facts {};
  if (::fstat(file_, &facts) != 0) return;
  if (S_ISDIR(facts.st_mode)) {
    close();
    fail_file(path_, "is a directory, but a log file is expected");
  }
  regular_ = S_ISREG(facts.st_mode);
  stamp_ = {facts.st_dev, facts.st_ino, facts.st_size};
}

/// Reopens the file and continues after the bytes that were read.
void FileBytes::open_again() {
  const Stamp before = stamp_;
  open();
  if (!(stamp_ == before)) {
    close();
    fail_file(path_, "was replaced or changed while it was read; run again when it is complete");
  }
  const auto read_so_far = std::max(static_cast<std::int64_t>(head_.size()), position_);
  if (::lseek(file_, static_cast<off_t>(read_so_far), SEEK_SET) < 0)
    fail_file(path_, "cannot be read to its end (" + reason() + ")");
}

void FileBytes::pause() {
  if (regular_) close();
}

void FileBytes::close() {
  if (file_ >= 0) ::close(file_);
  file_ = -1;
}

bool FileBytes::extend_head() {
  const std::size_t before = head_.size();
  if (file_ < 0) open_again();
  read_head(2 * before);
  if (regular_) close();
  return head_.size() > before;
}

void FileBytes::read_head(std::size_t bytes) {
  std::size_t got = head_.size();
  head_.resize(bytes);
  for (std::size_t more;
       got < head_.size() && (more = read_some(head_.data() + got, head_.size() - got)) > 0;)
    got += more;
  head_.resize(got);
}

std::size_t FileBytes::read_some(char* to, std::size_t size) {
  while (true) {
    const ssize_t got = ::read(file_, to, size);
    if (got >= 0) return static_cast<std::size_t>(got);
    if (errno != EINTR) fail_file(path_, "cannot be read to its end (" + reason() + ")");
  }
}

std::size_t FileBytes::read(char* to, std::size_t size) {
  std::size_t got = std::min(size, head_.size() - head_given_);
  if (got > 0) {
    std::memcpy(to, head_.data() + head_given_, got);
    head_given_ += got;
  } else if (!at_end_) {
    if (file_ < 0) open_again();
    got = read_some(to, size);
    at_end_ = got == 0 && size > 0;
    if (at_end_ && regular_) close();
  }
  position_ += static_cast<std::int64_t>(got);
  if (hash_) {
    hash_->update({to, got});
    if (got == 0 && size > 0) {
      sha256_ = hash_->hex();
      hash_.reset();
    }
  }
  return got;
}

void FileBytes::rewind() {
  if (regular_)
    close();
  else if (::lseek(file_, static_cast<off_t>(head_.size()), SEEK_SET) < 0)
    fail_file(path_, "cannot be read a second time (" + reason() + "); give a file, not a pipe");
  at_end_ = false;
  head_given_ = 0;
  position_ = 0;
  if (hash_) hash_.emplace();
}

double FileBytes::share_read() const {
  return stamp_.size > 0 ? std::min(1.0, static_cast<double>(position_) / static_cast<double>(stamp_.size))
                         : 0.0;
}

}  // namespace faultline
