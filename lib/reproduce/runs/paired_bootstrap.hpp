// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "lib/reproduce/runs/alarm_score.hpp"

namespace faultline {

/// A difference with its 95 % interval.
struct PairedDifference {
  double value = 0.0, low = 0.0, high = 0.0;
};

/// Of a value that each run has under two detectors: mean of `ours` minus mean of `theirs`, the interval by
/// drawing runs with replacement (paired bootstrap). Equal lengths; NaN for no runs.
PairedDifference paired_difference(std::span<const double> ours, std::span<const double> theirs,
                                   std::uint64_t seed = 1, int draws = 2000);

/// Per run: onset to alarm, `missed_s` where there was none.
std::vector<double> delays_of(const AlarmScore& score, double missed_s);
/// Per run: 1 where the fault was found and its joint (or kind and joint) named right.
std::vector<double> joints_right(const AlarmScore& score);
std::vector<double> kinds_right(const AlarmScore& score);

}  // namespace faultline
