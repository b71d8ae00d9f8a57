// SPDX-License-Identifier: MIT
#pragma once

#include <signal.h>

namespace faultline {

/// While it exists, its thread receives none of the signals of remove_files_on_signals(), and the handler on
/// another thread waits for its end, at most a second, so that a file being created is found.
class HeldSignals {
 public:
  HeldSignals();
  ~HeldSignals();
  HeldSignals(const HeldSignals&) = delete;
  HeldSignals& operator=(const HeldSignals&) = delete;

 private:
  sigset_t before_;
};

}  // namespace faultline
