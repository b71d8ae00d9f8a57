// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "lib/fault/fault_kind.hpp"

namespace faultline {

class Bank;
class History;
struct RunningHypothesis;

/// How the log likelihood ratio of one label against the healthy robot grew.
struct EvidenceCurve {
  FaultLabel label;
  std::vector<double> ratio;  ///< at EvidenceTrace::time; NaN before its onset
};

/// How the evidence of an episode grew until the fault was named, for the labels that explain it best.
struct EvidenceTrace {
  std::vector<double> time;           ///< s
  std::vector<EvidenceCurve> curves;  ///< the likeliest first
};

/// Runs the best hypotheses again from their onsets to sample `now` and notes how their ratios grew, at no
/// more than some 120 samples. `best` holds the end of each hypothesis of the bank.
EvidenceTrace trace_evidence(const Bank& bank, const History& history,
                             const std::vector<RunningHypothesis>& best, std::int64_t now);

}  // namespace faultline
