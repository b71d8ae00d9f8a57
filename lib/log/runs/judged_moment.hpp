// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

namespace faultline {

/// Returns the longest time, s, for which a joint of a healthy log may not be judged: half a second, and at
/// least ten samples. A lasting fault shows as soon as the joint is judged again; a shorter one, such as a
/// touch, moves no robot far. Alarms take some ten samples, too (docs/how-it-works.md).
inline double judged_moment_s(double sample_period_s) {
  constexpr double kMoment_s = 0.5, kMomentRows = 10.0;
  return std::max(kMoment_s, kMomentRows * sample_period_s);
}

/// The same at the end of a log, or of a run, after which the joint is not judged again: ten samples.
inline double judged_moment_at_end_s(double sample_period_s) {
  constexpr double kMomentRows = 10.0;
  return kMomentRows * sample_period_s;
}

/// Returns the length, s, of a window of ten moments. Interruptions that are each shorter than a moment hide
/// a fault as well if they add up to more than kLeastUnjudgedShare of a window.
inline double judged_window_s(double sample_period_s) {
  constexpr double kMoments = 10.0;
  return kMoments * judged_moment_s(sample_period_s);
}

inline constexpr double kLeastUnjudgedShare = 0.25;

}  // namespace faultline
