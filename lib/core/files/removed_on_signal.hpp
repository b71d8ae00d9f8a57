// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace faultline {

/// From now on SIGINT, SIGTERM and SIGHUP (unless ignored, as under nohup) first remove every file that a
/// RemovedOnSignal names, then end the program as they would have. For main(); the library sets no handler.
void remove_files_on_signals();

struct SignalSlot;

/// While this lives, a signal that ends the program removes the file. Any thread may hold any number.
class RemovedOnSignal {
 public:
  explicit RemovedOnSignal(const std::string& path);
  ~RemovedOnSignal();
  RemovedOnSignal(const RemovedOnSignal&) = delete;
  RemovedOnSignal& operator=(const RemovedOnSignal&) = delete;

 private:
  SignalSlot* slot_;  ///< null for a path too long for any file
};

/// Does not return when a signal is ending the program: what fails then, fails because of that.
void wait_if_ending();

}  // namespace faultline
