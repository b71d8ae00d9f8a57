// SPDX-License-Identifier: MIT
#include "formats/byte_source.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <limits>

#include "lib/core/error.hpp"

namespace faultline {
namespace {

[[noreturn]] void fail_file(const std::string& path, const std::string& what) {
  throw Error(ErrorCode::input, path, what);
}

std::string reason() { return std::strerror(errno); }

constexpr std::size_t kHeadBytes = 1 << 16;
constexpr std::size_t kPassedAtOnce = 1 << 16;

constexpr std::size_t kLeastCapacity = 1 << 18;

}  // namespace

FileBytes::FileBytes(std::string path, bool hashed) : path_(std::move(path)) {
  if (hashed) hash_.emplace();
  open();
  try {
    read_head(kHeadBytes);
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

ByteSource::ByteSource(const std::string& path, bool hashed)
    : file_(path, hashed), unpacker_(unpacker_of(file_)), budget_(path) {
  if (unpacker_) fill_head(kHeadBytes);
}

void ByteSource::fill_head(std::size_t bytes) {
  std::size_t got = head_.size();
  head_.resize(bytes);
  for (std::size_t more; got < bytes && (more = unpacker_->read(head_.data() + got, bytes - got)) > 0;)
    got += more;
  head_.resize(got);
  file_.pause();
}

bool ByteSource::extend_head() {
  if (!unpacker_) return file_.extend_head();
  const std::size_t before = head_.size();
  fill_head(2 * before);
  return head_.size() > before;
}

std::size_t ByteSource::read(char* to, std::size_t size) {
  if (!unpacker_) return file_.read(to, size);
  const std::size_t got = std::min(size, head_.size() - head_given_);
  if (got > 0) {
    std::memcpy(to, head_.data() + head_given_, got);
    head_given_ += got;
    return got;
  }
  const std::size_t more = unpacker_->read(to, size);
  spend(unpack_work_ns(unpacker_->byte_ns(), static_cast<std::int64_t>(more)));
  if (more == 0 && size > 0) note_end();
  return more;
}

void ByteSource::note_end() {
  read_to_end();
  const std::string damage = unpacker_->damage();
  if (damage.empty() || issues_.find("compression_damaged")) return;
  issues_.add({"compression_damaged", "", Severity::severe, damage});
}

void ByteSource::read_to_end() {
  std::string passed(kPassedAtOnce, '\0');
  while (file_.read(passed.data(), passed.size()) > 0) {
  }
}

void ByteSource::rewind() {
  file_.rewind();
  issues_ = {};
  budget_.start();
  if (!unpacker_) return;
  unpacker_ = unpacker_of(file_);
  head_given_ = 0;
  // read() hands out the head from head_; skip these bytes in the fresh unpacker.
  std::string again(head_.size(), '\0');
  for (std::size_t got = 0, more; got < again.size(); got += more)
    if ((more = unpacker_->read(again.data() + got, again.size() - got)) == 0) break;
}

/// Makes room after the view for at least one byte: moves the view to the front or enlarges the buffer.
void ByteWindow::make_room(std::size_t size) {
  const std::size_t have = end_ - begin_;
  if (have < capacity_) {
    if (begin_ == 0 || begin_ + std::max(size, capacity_ / 2) <= capacity_) return;
    std::memmove(bytes_.get(), bytes_.get() + begin_, have);
  } else {
    const std::size_t larger = std::max(kLeastCapacity, std::min(size, 2 * capacity_));
    std::unique_ptr<char[]> bytes(new char[larger]);
    if (have > 0) std::memcpy(bytes.get(), bytes_.get() + begin_, have);
    bytes_ = std::move(bytes);
    capacity_ = larger;
  }
  begin_ = 0;
  end_ = have;
}

bool ByteWindow::fill(std::size_t size) {
  while (end_ - begin_ < size && !at_end_) {
    make_room(size);
    const std::size_t got = source_.read(bytes_.get() + end_, capacity_ - end_);
    end_ += got;
    at_end_ = got == 0;
  }
  return end_ - begin_ >= size;
}

void ByteWindow::advance(std::size_t size) {
  begin_ += size;
  position_ += static_cast<std::int64_t>(size);
}

void ByteWindow::skip(std::uint64_t size) {
  while (size > 0 && fill(1)) {
    const std::size_t now = std::min<std::uint64_t>(size, view().size());
    advance(now);
    size -= now;
  }
}

std::uint64_t ByteWindow::left() const {
  if (source_.compression() || source_.file_size() == 0) return std::numeric_limits<std::uint64_t>::max();
  return static_cast<std::uint64_t>(std::max<std::int64_t>(0, source_.file_size() - position_));
}

std::int64_t ByteWindow::drain() {
  const std::int64_t before = position_;
  do advance(end_ - begin_);
  while (fill(1));
  return position_ - before;
}

void ByteWindow::clear() {
  begin_ = end_ = 0;
  position_ = 0;
  at_end_ = false;
}

}  // namespace faultline
