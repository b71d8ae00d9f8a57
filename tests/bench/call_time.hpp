// SPDX-License-Identifier: MIT
#pragma once

#include <ctime>
#include <vector>

namespace faultline {

inline double processor_ns() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return 1e9 * static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec);
}

/// Returns the processor time of a call of a function of one number, ns: the mean over `repeats` passes
/// through the arguments.
template <typename F>
double time_of(const F& function, const std::vector<double>& arguments, int repeats) {
  volatile double kept = 0.0;
  const double begin = processor_ns();
  for (int repeat = 0; repeat < repeats; ++repeat) {
    double sum = 0.0;
    for (const double x : arguments) sum += function(x);
    kept = sum;
  }
  (void)kept;
  return (processor_ns() - begin) / (repeats * static_cast<double>(arguments.size()));
}

}  // namespace faultline
