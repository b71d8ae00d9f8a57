// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <string>

#include "apps/terminal.hpp"
#include "lib/core/progress.hpp"

namespace faultline {

/// A progress bar on standard error while the object lives, if that is a terminal; else nothing. Give
/// `callback()` to the long work. The bar appears after `delay_s`, so that short work shows none.
class ProgressBar {
 public:
  explicit ProgressBar(ColorChoice color, double delay_s = 0.3);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Valid while the bar lives; empty when there is no terminal.
  Progress callback();

 private:
  void show(const std::string& what, double share);

  bool on_terminal_;
  bool color_;
  bool shown_ = false;
  std::chrono::steady_clock::time_point next_;
};

}  // namespace faultline
