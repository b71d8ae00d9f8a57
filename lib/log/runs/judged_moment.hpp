// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

namespace faultline {

/// How long a joint may go without being judged, s, in a log that is called healthy: half a second, and at
/// least ten samples. What a fault does that lasts shows as soon as the joint is judged again; what is over
/// sooner, such as a touch, moves no robot far. Alarms take some ten samples, too (docs/how-it-works.md).
inline double judged_moment_s(double sample_period_s) {
  constexpr double kMoment_s = 0.5, kMomentRows = 10.0;
  return std::max(kMoment_s, kMomentRows * sample_period_s);
}

/// The same at the end of a log, or of a run, after which the joint is not judged again: ten samples.
inline double judged_moment_at_end_s(double sample_period_s) {
  constexpr double kMomentRows = 10.0;
  return kMomentRows * sample_period_s;
}

/// Ten moments, s. What lacks less than a moment at a time, again and again, hides a fault as well where it
/// adds up within them to more than kLeastUnjudgedShare.
inline double judged_window_s(double sample_period_s) {
  constexpr double kMoments = 10.0;
  return kMoments * judged_moment_s(sample_period_s);
}

inline constexpr double kLeastUnjudgedShare = 0.25;

}  // namespace faultline
