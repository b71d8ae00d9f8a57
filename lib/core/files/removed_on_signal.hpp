// SPDX-License-Identifier: MIT
#pragma once

#include <signal.h>

#include <string>

namespace faultline {

/// Makes SIGINT, SIGTERM and SIGHUP (unless ignored, as under nohup) first remove every file of a
/// RemovedOnSignal and then end the program as they would have. For main(); the library sets no handler.
void remove_files_on_signals();

struct SignalSlot;

/// While it exists, a signal that ends the program removes the file. Any thread may hold any number.
class RemovedOnSignal {
 public:
  explicit RemovedOnSignal(const std::string& path);
  ~RemovedOnSignal();
  RemovedOnSignal(const RemovedOnSignal&) = delete;
  RemovedOnSignal& operator=(const RemovedOnSignal&) = delete;

 private:
  SignalSlot* slot_;  ///< null for a path that is too long for any file
};

/// Does not return if a signal is ending the program, as failures are then caused by that.
void wait_if_ending();

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
