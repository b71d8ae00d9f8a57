// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "lib/explain/hypothesis.hpp"

namespace faultline {

inline constexpr double kSameOnset_s = 0.08;  ///< between two onsets that count as one

/// Judges hypotheses of one log and keeps them all.
struct JudgedHypotheses {
  const LogFit& fit;
  std::vector<FaultHypothesis> judged{};

  /// Judges a claim. Empty if it cannot be judged, or if a known fault silences its joint or is the same.
  std::optional<FaultHypothesis> go(const FaultClaim& claim);
  /// Returns the nats of the best one; 0 if none explains more than the healthy robot.
  double best_gain() const;
};

/// Returns the best of each kind and joint, best first.
std::vector<FaultHypothesis> best_of_each(const std::vector<FaultHypothesis>& all);

/// Adds the hypothesis with the best onset and end. If the log shows that the fault is gone, the hypothesis
/// with an end replaces those that last longer.
void refine(const FaultHypothesis& hypothesis, JudgedHypotheses& bench);

}  // namespace faultline
