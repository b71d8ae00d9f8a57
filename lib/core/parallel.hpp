// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>

#include "lib/core/progress.hpp"

namespace faultline {

/// Calls work(i) for i = 0 .. count-1 on `threads` threads (0 = one per core), or on as many as can be
/// started. Each i must write to its own place, so that the result does not depend on the number of threads.
/// The first exception, by i, is thrown again.
void parallel_for(int count, int threads, const std::function<void(int)>& work);

/// The same, and reports the share of the calls that are done, with the name `what` of the work.
void parallel_steps(const std::string& what, int count, int threads, const Progress& progress,
                    const std::function<void(int)>& work);

}  // namespace faultline
