// SPDX-License-Identifier: MIT
#pragma once

#include <cctype>
#include <cstddef>
#include <cstdio>
#include <optional>
#include <string>
#include <string_view>

#include "lib/core/error.hpp"
#include "lib/core/files/temporary_file.hpp"

namespace faultline {

/// A file that appears under its final name only if commit() succeeds: bytes go to a TemporaryFile beside it.
/// The path "-" is standard output; a pipe, a device or an open file (/dev/stdout) is written directly. A
/// failure to write throws Error(output), except for a pipe that its reader has closed.
class AtomicFile {
 public:
  explicit AtomicFile(std::string path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(std::string_view bytes);
  void commit();

 private:
  [[noreturn]] void fail(const char* doing);

  std::string path_;
  std::optional<TemporaryFile> temporary_;
  std::FILE* file_ = nullptr;
  bool to_stdout_ = false;
};

void write_file(const std::string& path, std::string_view bytes);
/// Returns the bytes. Throws Error(input) for a file that is missing, a directory, unreadable or longer than
/// `most_bytes`, as is a device without end.
std::string read_file(const std::string& path, std::size_t most_bytes = std::size_t{1} << 30);

/// Throws Error(input) for a file that ends, without a line break, in a number: truncation may have cut off
/// digits unnoticed. Any other truncated file does not parse.
inline void refuse_open_number(const std::string& text, const std::string& path) {
  if (text.empty() || !(std::isdigit(static_cast<unsigned char>(text.back())) || text.back() == '.')) return;
  throw Error(ErrorCode::input, path,
              "ends in a number without a line break and may be truncated: restore it, or end its last line "
              "with a line break");
}

}  // namespace faultline
