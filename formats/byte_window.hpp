// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string_view>

#include "formats/byte_source.hpp"

namespace faultline {

/// The bytes of a file from front to back, in contiguous pieces of the requested size. The memory it takes
/// depends on the bytes that the file holds, never on the sizes that it states.
class ByteWindow {
 public:
  explicit ByteWindow(ByteSource& source) : source_(source) {}

  /// Brings at least the next `size` bytes into view, or all that remain; false when there are fewer.
  bool fill(std::size_t size);
  /// The bytes in memory from the current position on; valid until the next fill().
  std::string_view view() const { return {bytes_.get() + begin_, end_ - begin_}; }
  /// Moves forward by `size` bytes, which must be in view.
  void advance(std::size_t size);
  /// Moves forward by `size` bytes, in view or not, or to the end of the file.
  void skip(std::uint64_t size);
  /// Bytes advanced over since the beginning.
  std::int64_t position() const { return position_; }
  /// Reads to the end of the file; returns the number of remaining bytes, including the view.
  std::int64_t drain();
  /// Starts again, after the source was rewound.
  void clear();

 private:
  void make_room(std::size_t size);

  ByteSource& source_;
  std::unique_ptr<char[]> bytes_;
  std::size_t capacity_ = 0;
  std::size_t begin_ = 0, end_ = 0;  ///< of the view, in bytes_
  std::int64_t position_ = 0;
  bool at_end_ = false;  ///< of the file
};

}  // namespace faultline
