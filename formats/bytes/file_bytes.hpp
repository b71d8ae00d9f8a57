// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "lib/core/hash.hpp"

namespace faultline {

/// The bytes of a file from front to back, with a hash if requested. A regular file is open only while it is
/// read, so that a command may have any number of them; a file that was replaced meanwhile is rejected. Every
/// failure throws Error(input).
class FileBytes {
 public:
  explicit FileBytes(std::string path, bool hashed = true);
  ~FileBytes();
  FileBytes(const FileBytes&) = delete;
  FileBytes& operator=(const FileBytes&) = delete;

  const std::string& path() const { return path_; }
  /// The first bytes of the file, up to 64 KiB unless extended, independent of what was read.
  std::string_view head() const { return head_; }
  /// Doubles the head, as far as the file goes; false at its end. Allowed only before the first read();
  /// invalidates views of the head.
  bool extend_head();
  /// Copies up to `size` of the next bytes to `to`; 0 at the end of the file.
  std::size_t read(char* to, std::size_t size);
  void rewind();
  /// Closes a regular file until the next read().
  void pause();
  /// SHA-256 of all bytes, once the end was reached; empty before and if hashing is off.
  const std::string& sha256() const { return sha256_; }
  double share_read() const;
  /// Bytes read since the beginning.
  std::int64_t position() const { return position_; }
  /// Size of the file in bytes, 0 for a pipe.
  std::int64_t size() const { return regular_ ? stamp_.size : 0; }

 private:
  /// Properties of the file that show whether it was replaced or changed.
  struct Stamp {
    std::uint64_t device = 0, inode = 0;
    std::int64_t size = 0;
    bool operator==(const Stamp&) const = default;
  };

  void open();
  void open_again();
  void close();
  void read_head(std::size_t bytes);
  std::size_t read_some(char* to, std::size_t size);

  std::string path_;
  int file_ = -1;
  bool regular_ = false;
  bool at_end_ = false;
  Stamp stamp_;
  std::int64_t position_ = 0;
  std::string head_;
  std::size_t head_given_ = 0;  ///< bytes of head_ handed out by read()
  std::optional<Sha256> hash_;  ///< empty if not requested, or finished
  std::string sha256_;
};

}  // namespace faultline
