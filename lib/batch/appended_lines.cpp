// SPDX-License-Identifier: MIT
#include "lib/batch/appended_lines.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "lib/core/error.hpp"
#include "lib/core/files/output_place.hpp"

namespace faultline {

AppendedLines::AppendedLines(std::string path) : path_(std::move(path)) {
  refuse_other_names(path_);
  file_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (file_ < 0)
    throw Error(ErrorCode::output, path_, std::string("cannot be opened (") + std::strerror(errno) + ")");
  add("\n");
}

AppendedLines::~AppendedLines() { ::close(file_); }

void AppendedLines::add(const std::string& line) {
  const auto written = ::write(file_, line.data(), line.size());
  if (written == static_cast<ssize_t>(line.size())) return;
  const std::string why = written < 0 ? std::strerror(errno) : "no space left";
  throw Error(
      ErrorCode::output, path_,
      "cannot be written (" + why + "); finished logs are kept: make room and run the same command again");
}

}  // namespace faultline
