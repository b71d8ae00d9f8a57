// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace faultline {

/// A file to whose end lines are added, each by one write, so that a kill can cut only the last one.
class AppendedLines {
 public:
  /// Ends a line that a kill has cut. Throws Error(output) if the file cannot be opened or has other names
  /// (hard links).
  explicit AppendedLines(std::string path);
  ~AppendedLines();
  AppendedLines(const AppendedLines&) = delete;
  AppendedLines& operator=(const AppendedLines&) = delete;
  /// `line` ends with its line break. Throws Error(output).
  void add(const std::string& line);

 private:
  std::string path_;
  int file_ = -1;
};

}  // namespace faultline
