// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/fault/fault_kind.hpp"

namespace faultline {

/// Evidence of one label against the healthy robot over time.
struct EvidenceCurve {
  FaultLabel label;
  std::vector<double> ratio;  ///< nats at EvidenceTrace::time; NaN before its onset
};

/// Evidence of the labels that explain a fault best, over time.
struct EvidenceTrace {
  std::vector<double> time;           ///< s
  double limit = 0.0;                 ///< nats that raise the alarm
  std::vector<EvidenceCurve> curves;  ///< the most likely first
};

/// Evidence of a hypothesis from its onset on.
struct EvidenceCourse {
  std::vector<double> time_s;  ///< rising
  std::vector<double> nats;    ///< of all rows up to that time

  /// Returns the first time at which the evidence exceeds `threshold`; the last time if it never does.
  double alarm_s(double threshold) const;
};

/// Returns the courses of labels, the most likely first, at some 120 common times at most, up to `until_s`.
EvidenceTrace trace_of(const std::vector<FaultLabel>& labels, const std::vector<EvidenceCourse>& courses,
                       double until_s);

}  // namespace faultline
