// SPDX-License-Identifier: MIT
#pragma once

#include <signal.h>

namespace faultline {

/// As long as it lives, its thread takes none of the signals of remove_files_on_signals(), and the handler on
/// another thread waits for its end, a second at most: so that a file that is just being made is found.
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
