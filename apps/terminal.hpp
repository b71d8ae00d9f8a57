// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdio>
#include <string>
#include <string_view>

#include "lib/core/progress.hpp"

namespace faultline {

enum class ColorChoice { automatic, always, never };  // in the order of --color

/// True when output to `stream` is coloured: `automatic` means on a terminal unless NO_COLOR is set and not
/// empty, or TERM is "dumb".
bool use_color(ColorChoice choice, std::FILE* stream);

/// Writes a result to standard output at once after outgoing(), which keeps the codes of painted() only with
/// `color`. Throws Error(output) when it cannot be written.
void print(std::string_view text, bool color = false);

/// Writes "faultline: " and the sentence, shortened by brief(), to standard error.
void print_message(std::string_view sentence);

/// Call it first: a closed pipe and a file size limit then cause write errors instead of signals, and closed
/// standard streams cannot be confused with files opened later.
void prepare_standard_streams();

/// Progress of long work on standard error: a bar while the object lives if that is a terminal, else a line
/// now and then, ever more rarely. Give `callback()` to the work. Short work shows none.
class ProgressBar {
 public:
  explicit ProgressBar(ColorChoice color);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Valid while the bar lives.
  Progress callback();

 private:
  void show(const std::string& what, double share);

  bool on_terminal_;
  bool color_;
  bool shown_ = false;
  std::chrono::steady_clock::time_point begin_, next_;
};

}  // namespace faultline
