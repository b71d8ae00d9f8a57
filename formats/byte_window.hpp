// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string_view>

#include "formats/byte_source.hpp"

namespace faultline {

/// The bytes of a file from front to back, as many of them in one piece as are asked for. The memory it takes
/// grows with what the file holds, never with what it promises.
class ByteWindow {
 public:
  explicit ByteWindow(ByteSource& source) : source_(source) {}

  /// Brings at least the next `size` bytes into view, or all that are left; whether there are so many.
  bool fill(std::size_t size);
  /// The bytes in memory from the present place on; valid until the next fill().
  std::string_view view() const { return {bytes_.get() + begin_, end_ - begin_}; }
  /// Goes on by so many of the bytes in view.
  void advance(std::size_t size);
  /// Goes on by so many bytes, in view or not, as far as there are some.
  void skip(std::uint64_t size);
  /// Bytes advanced over since the beginning.
  std::int64_t position() const { return position_; }
  /// Reads on to the end of the file; the number of bytes that were left, view included.
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
