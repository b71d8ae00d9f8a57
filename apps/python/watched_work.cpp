// SPDX-License-Identifier: MIT
#include "apps/python/watched_work.hpp"

#include <chrono>
#include <cmath>
#include <exception>
#include <thread>

#include "lib/log/transformed/watched_source.hpp"

namespace faultline {
namespace {

namespace py = pybind11;

constexpr auto kPause = std::chrono::milliseconds(50);

/// Handles signals and reports the progress; throws the exceptions of Python.
void serve(const py::object& progress, ProgressRelay& watch) {
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  const auto reported = watch.take();
  if (reported && !progress.is_none()) progress(reported->first, reported->second);
}

}  // namespace

void ProgressRelay::report(const std::string& what, double share) {
  check();
  const std::lock_guard lock(mutex_);
  told_ = {what, share};
}

void ProgressRelay::finish() {
  const std::lock_guard lock(mutex_);
  done_ = true;
  changed_.notify_all();
}

bool ProgressRelay::wait() {
  std::unique_lock lock(mutex_);
  return changed_.wait_for(lock, kPause, [this] { return done_; });
}

std::optional<std::pair<std::string, double>> ProgressRelay::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(told_, std::nullopt);
}

void run_with_progress(const py::object& progress, const std::function<void(ProgressRelay&)>& work) {
  ProgressRelay watch;
  std::exception_ptr of_work, of_python;
  std::thread worker([&] {
    try {
      work(watch);
    } catch (...) {
      of_work = std::current_exception();
    }
    watch.finish();
  });
  for (bool done = false; !done;) {
    {
      const py::gil_scoped_release others_run;
      done = watch.wait();
      if (done) worker.join();
    }
    try {
      if (!of_python) serve(progress, watch);
    } catch (...) {
      of_python = std::current_exception();
      watch.stop();
    }
  }
  if (of_python) std::rethrow_exception(of_python);
  if (of_work) std::rethrow_exception(of_work);
}

std::unique_ptr<LogSource> interruptible(std::unique_ptr<LogSource> log, ProgressRelay& watch,
                                         bool reports_progress) {
  const std::string what = "reading " + log->identity().path;
  return watched_log(std::move(log), [&watch, what, reports_progress](double share) {
    if (reports_progress && std::isfinite(share))
      watch.report(what, share);
    else
      watch.check();
  });
}

}  // namespace faultline
