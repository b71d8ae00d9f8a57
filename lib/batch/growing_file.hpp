// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace faultline {

/// A file that grows line by line for readers who follow it. What it already holds from an earlier run and
/// what comes again stays untouched; from the first difference on it is written anew. A file that has other
/// names, too (hard links), keeps those and its content: under this one a new file takes its place.
class GrowingFile {
 public:
  /// Throws Error(output).
  explicit GrowingFile(std::string path);
  ~GrowingFile();
  GrowingFile(const GrowingFile&) = delete;
  GrowingFile& operator=(const GrowingFile&) = delete;

  void append(std::string_view text);
  /// Cuts what an earlier run had beyond the end.
  void finish();

 private:
  void begin_anew();
  bool is_there_already(std::string_view text) const;
  [[noreturn]] void fail() const;

  std::string path_;
  int file_ = -1;
  long long size_ = 0;
  bool anew_ = false;
};

}  // namespace faultline
