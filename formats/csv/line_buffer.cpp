// SPDX-License-Identifier: MIT
#include "formats/csv/line_buffer.hpp"

#include <cstring>

#include "lib/core/error.hpp"

namespace faultline {
namespace {

constexpr std::size_t kBlock = 1 << 18;
constexpr std::size_t kKeptBefore = 1 << 12;

}  // namespace

bool LineBuffer::fill() {
  while (begin_ == lines_end_) {
    if (at_end_) return false;
    if (begin_ > 0) {
      keep_before();
      std::memmove(text(), text() + begin_, end_ - begin_);
      end_ -= begin_;
      begin_ = lines_end_ = 0;
    }
    if (end_ > kLongestLine)
      throw Error(ErrorCode::input, bytes_.path(),
                  "has a line of more than 16 MiB; a log in text has short lines");
    const std::size_t needed = end_ + kBlock + 1 + 2 * kNumberMargin;
    if (bytes_read_.size() < needed) bytes_read_.resize(needed);
    const std::size_t got = bytes_.read(text() + end_, kBlock);
    if (got == 0) {
      at_end_ = true;
      last_line_was_open_ = end_ > 0;
      if (end_ > 0) text()[end_++] = '\n';
      lines_end_ = end_;
      continue;
    }
    const void* newline = ::memrchr(text() + end_, '\n', got);
    end_ += got;
    if (newline) lines_end_ = static_cast<std::size_t>(static_cast<const char*>(newline) - text()) + 1;
  }
  return true;
}

void LineBuffer::keep_before() {
  const std::size_t from = begin_ > kKeptBefore ? begin_ - kKeptBefore : 0;
  before_.assign(text() + from, begin_ - from);
  if (from > 0) before_.erase(0, before_.find('\n') + 1);  // its first line is not whole
}

void LineBuffer::clear() {
  before_.clear();
  begin_ = lines_end_ = end_ = 0;
  at_end_ = last_line_was_open_ = false;
}

}  // namespace faultline
