// SPDX-License-Identifier: MIT
#pragma once

#include <limits>

#include "lib/fault/fault_kind.hpp"

namespace faultline {

/// How near a log comes to an alarm: the evidence of the hypothesis that is nearest to its limit, or beyond
/// it by most.
struct EvidenceScore {
  FaultLabel label{};       ///< of that hypothesis; `none` if none was judged
  double onset_s = 0.0;     ///< of that hypothesis
  double evidence = 0.0;    ///< nats; 0 if the healthy robot explains the log better
  double limit = kNoLimit;  ///< nats beyond which there is an alarm; infinite if no hypothesis was judged

  static constexpr double kNoLimit = std::numeric_limits<double>::infinity();

  bool is_known() const { return limit < kNoLimit; }
  /// Evidence by limit: an alarm is raised above 1.
  double ratio() const { return evidence / limit; }
};

/// Returns the one with the larger ratio; a known one in place of one that is not known.
inline EvidenceScore larger(const EvidenceScore& a, const EvidenceScore& b) {
  if (!a.is_known() || !b.is_known()) return a.is_known() ? a : b;
  return b.ratio() > a.ratio() ? b : a;
}

}  // namespace faultline
