// SPDX-License-Identifier: MIT
#pragma once

#include <zlib.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "formats/bytes/work_budget.hpp"

namespace faultline {

/// A file that is open for reading at any position.
class RandomFile {
 public:
  /// Throws Error(input) when it cannot be opened.
  explicit RandomFile(const std::string& path);
  ~RandomFile();
  RandomFile(const RandomFile&) = delete;
  RandomFile& operator=(const RandomFile&) = delete;

  std::int64_t size() const { return size_; }
  /// Returns the number of bytes read, less than `count` only at the end. Throws Error(input) when reading
  /// fails.
  std::size_t read(std::int64_t at, char* to, std::size_t count) const;
  std::string text(std::int64_t at, std::size_t count) const;
  /// Counts the work of unpacking, see WorkBudget.
  void spend(std::int64_t work_ns) const { budget_.spend(work_ns, size_); }
  [[noreturn]] void fail(const std::string& what) const;

 private:
  std::string path_;
  int file_ = -1;
  std::int64_t size_ = 0;
  mutable WorkBudget budget_;
};

enum class Packing { plain, deflate, zlib };

/// A stretch of a file, plain or compressed.
struct StoredContent {
  std::string name;
  std::int64_t offset = 0, bytes = 0;  ///< in the file, within its end
  Packing packing = Packing::plain;
  std::optional<std::int64_t> unpacked{};  ///< bytes, according to the file
  std::optional<std::uint32_t> crc{};      ///< of the unpacked bytes
};

/// Returns the upper limit of the unpacked size in bytes.
std::int64_t most_bytes(const StoredContent& content);

/// The unpacked bytes of a content; reading an earlier position unpacks again from the beginning.
class ContentStream {
 public:
  /// `file` must outlive the object.
  ContentStream(const RandomFile& file, const StoredContent& content);
  ~ContentStream();
  ContentStream(const ContentStream&) = delete;
  ContentStream& operator=(const ContentStream&) = delete;

  /// Returns the number of bytes read, fewer if the content ends or is damaged.
  std::size_t read(std::int64_t at, char* to, std::size_t count);
  /// True when all was read in order and the checksum does not match; for zlib, reads the rest to check it.
  bool mismatch();

 private:
  bool is_packed() const { return content_.packing != Packing::plain; }
  void restart();
  void fill();
  std::size_t unpack(char* to, std::size_t count);
  std::size_t pass(std::size_t count);

  const RandomFile& file_;
  const StoredContent content_;
  // The following is only used for compressed contents.
  z_stream stream_{};
  std::vector<char> input_, passed_;
  std::int64_t taken_ = 0;     ///< bytes of the content in the file
  std::int64_t position_ = 0;  ///< unpacked bytes
  std::uint32_t crc_ = 0;
  bool begun_ = false, ok_ = false, ended_ = false;
  bool wrong_ = false;  ///< compressed bytes or zlib checksum are damaged
};

}  // namespace faultline
