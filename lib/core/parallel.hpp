// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

namespace faultline {

/// Calls work(i) for i = 0 .. count-1 on `threads` threads (0 = one per core), or on as many as can be
/// started. Each i must write to its own place, so that the result does not depend on the number of threads.
/// The first exception, by i, is thrown again.
void parallel_for(int count, int threads, const std::function<void(int)>& work);

}  // namespace faultline
