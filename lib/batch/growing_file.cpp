// SPDX-License-Identifier: MIT
#include "lib/batch/growing_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "lib/core/error.hpp"
#include "lib/core/files/other_names.hpp"

namespace faultline {

GrowingFile::GrowingFile(std::string path) : path_(std::move(path)) {
  file_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (file_ >= 0 && has_other_names(file_)) begin_anew();
  if (file_ < 0) fail();
}

/// The file has the other name from now on, this one gets a new file.
void GrowingFile::begin_anew() {
  ::close(file_);
  file_ = -1;
  if (::unlink(path_.c_str()) == 0)
    file_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
}

GrowingFile::~GrowingFile() { ::close(file_); }

bool GrowingFile::is_there_already(std::string_view text) const {
  std::string there(text.size(), '\0');
  const auto got = ::pread(file_, there.data(), there.size(), size_);
  return got == static_cast<ssize_t>(text.size()) && there == text;
}

void GrowingFile::append(std::string_view text) {
  if (anew_ || !is_there_already(text)) {
    if (!anew_ && ::ftruncate(file_, size_) != 0) fail();
    anew_ = true;
    const auto written = ::pwrite(file_, text.data(), text.size(), size_);
    if (written != static_cast<ssize_t>(text.size())) {
      if (written >= 0) errno = ENOSPC;
      const int why = errno;
      if (::ftruncate(file_, size_) == 0) errno = why;  // whole lines only
      fail();
    }
  }
  size_ += static_cast<long long>(text.size());
}

void GrowingFile::finish() {
  if (::ftruncate(file_, size_) != 0) fail();
}

void GrowingFile::fail() const {
  throw Error(ErrorCode::output, path_,
              std::string("cannot be written (") + std::strerror(errno) +
                  "); finished logs are kept: make room and run the same command again");
}

}  // namespace faultline
