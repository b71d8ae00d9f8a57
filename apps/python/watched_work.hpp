// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "lib/core/progress.hpp"
#include "lib/log/log_source.hpp"

namespace faultline {

/// Thrown through work that Python ends; no std::exception, so that no handler mistakes it for a failure of
/// the work.
struct Interruption {};

/// Connects work in a thread of its own with Python, which waits for it and receives its progress.
class ProgressRelay {
 public:
  /// Reports the progress; the work calls it regularly. Throws Interruption when the work must end.
  void report(const std::string& what, double share);
  void check() const {
    if (stopped_) throw Interruption{};
  }
  /// Returns report() as callback for work that takes one.
  Progress progress() {
    return [this](const std::string& what, double share) { report(what, share); };
  }

  void stop() { stopped_ = true; }
  void finish();
  /// Waits for a short time; true when the work is done.
  bool wait();
  /// Returns the last progress, once.
  std::optional<std::pair<std::string, double>> take();

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<std::pair<std::string, double>> told_;
  std::atomic<bool> stopped_ = false;
  bool done_ = false;
};

/// Runs the work in a thread without Python's lock. The calling thread handles signals (Ctrl-C) and passes
/// the progress to `progress`, a callable (what, share) or None; an exception of either ends the work and is
/// raised again.
void run_with_progress(const pybind11::object& progress, const std::function<void(ProgressRelay&)>& work);

template <typename Work>
auto watched(const pybind11::object& progress, Work work) {
  std::optional<decltype(work(std::declval<ProgressRelay&>()))> result;
  run_with_progress(progress, [&](ProgressRelay& watch) { result.emplace(work(watch)); });
  return std::move(*result);
}

/// Returns a log that ends the work that reads it if requested; reports the share read if `reports_progress`
/// is set.
std::unique_ptr<LogSource> interruptible(std::unique_ptr<LogSource> log, ProgressRelay& watch,
                                         bool reports_progress);

}  // namespace faultline
