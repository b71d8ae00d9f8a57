// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/fault/fault_kind.hpp"

namespace faultline {

/// How the evidence of one label against the healthy robot grows, rows in order.
struct EvidenceCurve {
  FaultLabel label;
  std::vector<double> ratio;  ///< nats at EvidenceTrace::time; NaN before its onset
};

/// How the evidence of the labels grows that explain a fault best.
struct EvidenceTrace {
  std::vector<double> time;           ///< s
  double limit = 0.0;                 ///< nats that raise the alarm
  std::vector<EvidenceCurve> curves;  ///< the likeliest first
};

/// Evidence of a hypothesis from its onset on.
struct EvidenceCourse {
  std::vector<double> time_s;  ///< rising
  std::vector<double> nats;    ///< of all rows up to that time

  /// The first time at which the evidence passes `threshold`; the last time where it never does.
  double alarm_s(double threshold) const;
};

/// Courses of several labels, the likeliest first, at no more than some 120 common times up to `until_s`.
EvidenceTrace trace_of(const std::vector<FaultLabel>& labels, const std::vector<EvidenceCourse>& courses,
                       double until_s);

}  // namespace faultline
