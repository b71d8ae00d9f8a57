// SPDX-License-Identifier: MIT
#include "lib/core/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace faultline {

void parallel_for(int count, int threads, const std::function<void(int)>& work) {
  if (threads <= 0) threads = std::max(1u, std::thread::hardware_concurrency());
  threads = std::min(threads, count);
  std::vector<std::exception_ptr> failures(std::max(count, 0));
  std::atomic<int> next = 0;
  auto run = [&] {
    for (int i; (i = next.fetch_add(1)) < count;) {
      try {
        work(i);
      } catch (...) {
        failures[i] = std::current_exception();
      }
    }
  };
  std::vector<std::thread> helpers;
  try {
    for (int t = 1; t < threads; ++t) helpers.emplace_back(run);
  } catch (const std::system_error&) {
    // no more threads can be started: the existing ones do all the work
  }
  run();
  for (std::thread& helper : helpers) helper.join();
  for (const std::exception_ptr& failure : failures)
    if (failure) std::rethrow_exception(failure);
}

void parallel_steps(const std::string& what, int count, int threads, const Progress& progress,
                    const std::function<void(int)>& work) {
  std::mutex reporting;
  int done = 0;
  parallel_for(count, threads, [&](int i) {
    work(i);
    const std::lock_guard lock(reporting);
    if (progress) progress(what, static_cast<double>(++done) / count);
  });
}

}  // namespace faultline
