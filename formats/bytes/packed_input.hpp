// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "formats/bytes/file_bytes.hpp"

namespace faultline {

/// Buffers the compressed bytes of a file for a library that consumes any number of those in view.
class PackedInput {
 public:
  explicit PackedInput(FileBytes& file) : file_(file), bytes_(kAtOnce, '\0') {}

  /// Bytes not yet taken; reads more when there are none. Empty at the end of the file.
  std::string_view view() {
    if (begin_ == end_) {
      begin_ = 0;
      end_ = file_.read(bytes_.data(), bytes_.size());
    }
    return {bytes_.data() + begin_, end_ - begin_};
  }
  void take(std::size_t size) {
    begin_ += size;
    position_ += static_cast<std::int64_t>(size);
  }
  /// Bytes taken since the beginning.
  std::int64_t position() const { return position_; }

 private:
  static constexpr std::size_t kAtOnce = 1 << 16;

  FileBytes& file_;
  std::string bytes_;
  std::size_t begin_ = 0, end_ = 0;
  std::int64_t position_ = 0;
};

}  // namespace faultline
