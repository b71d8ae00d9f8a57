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

/// Thrown through work that is to end because Python wants it to; no std::exception, so that nothing on the
/// way takes it for a failure of the work.
struct Interruption {};

/// Between work in a thread of its own and Python, which waits for it and is told how far it is.
class WorkWatch {
 public:
  /// To be called by the work now and then. Throws Interruption when it is to end.
  void tell(const std::string& what, double share);
  void check() const {
    if (stopped_) throw Interruption{};
  }
  /// As callback for work that has one.
  Progress progress() {
    return [this](const std::string& what, double share) { tell(what, share); };
  }

  void stop() { stopped_ = true; }
  void finish();
  /// Waits for a while; whether the work is done.
  bool wait();
  /// What was told last, once.
  std::optional<std::pair<std::string, double>> take();

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<std::pair<std::string, double>> told_;
  std::atomic<bool> stopped_ = false;
  bool done_ = false;
};

/// Runs the work in a thread without Python's lock. The calling thread takes signals (Ctrl-C) and hands what
/// the work tells to `progress`, a callable (what, share) or None; what these raise ends the work and is
/// raised again.
void run_watched(const pybind11::object& progress, const std::function<void(WorkWatch&)>& work);

template <typename Work>
auto watched(const pybind11::object& progress, Work work) {
  std::optional<decltype(work(std::declval<WorkWatch&>()))> result;
  run_watched(progress, [&](WorkWatch& watch) { result.emplace(work(watch)); });
  return std::move(*result);
}

/// A log that ends the work that reads it when it is to end; tells how far it was read when asked to.
std::unique_ptr<LogSource> interruptible(std::unique_ptr<LogSource> log, WorkWatch& watch, bool tells);

}  // namespace faultline
