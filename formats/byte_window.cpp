// SPDX-License-Identifier: MIT
#include "formats/byte_window.hpp"

#include <algorithm>
#include <cstring>

namespace faultline {
namespace {

constexpr std::size_t kLeastCapacity = 1 << 18;

}  // namespace

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
