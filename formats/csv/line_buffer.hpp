// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "formats/byte_source.hpp"
#include "formats/csv/number.hpp"

namespace faultline {

inline constexpr std::size_t kLongestLine = 1 << 24;  ///< bytes

/// Whole lines of a text file in a window of bounded size, with kNumberMargin bytes around them. A file whose
/// last line has no newline gets one.
class LineBuffer {
 public:
  explicit LineBuffer(ByteSource& bytes) : bytes_(bytes) {}

  /// Whole lines from `position()` on, each ended by '\n'; empty when more must be filled in.
  const char* position() const { return text() + begin_; }
  const char* end_of_lines() const { return text() + lines_end_; }
  void advance_to(const char* position) { begin_ = static_cast<std::size_t>(position - text()); }
  /// Reads on until a whole line is there; false at the end of the file. Pointers into the buffer end here.
  /// Throws Error(input) for a line longer than kLongestLine.
  bool fill();
  /// True when the line that ends the present lines is the last of the file and had no newline.
  bool last_line_was_open() const { return last_line_was_open_; }
  /// Whole lines just before that one, a few KiB at most.
  std::string_view lines_before() const { return before_; }
  void clear();

 private:
  const char* text() const { return bytes_read_.data() + kNumberMargin; }
  char* text() { return bytes_read_.data() + kNumberMargin; }
  void keep_before();

  ByteSource& bytes_;
  std::vector<char> bytes_read_;  ///< with kNumberMargin bytes around them
  std::string before_;            ///< the last lines that fill() dropped
  std::size_t begin_ = 0;
  std::size_t lines_end_ = 0;
  std::size_t end_ = 0;
  bool at_end_ = false;
  bool last_line_was_open_ = false;
};

}  // namespace faultline
