// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

#include "lib/evidence/bank.hpp"
#include "lib/evidence/filter/history.hpp"

namespace faultline {

inline bool better(const RunningHypothesis& a, const RunningHypothesis& b) {
  return a.log_likelihood_ratio > b.log_likelihood_ratio;
}

/// The samples that a suspicion is tested on.
struct TestedSamples {
  std::int64_t earliest = 0;  ///< from which a hypothesis can start
  std::int64_t trigger = 0;   ///< that aroused it
  std::int64_t now = 0;       ///< the last one
};

/// A hypothesis from its onset to the sample `until`; `duration_s` for a pulse of another length than its
/// own.
RunningHypothesis run_hypothesis(const Bank& bank, const History& history, int hypothesis, std::int64_t onset,
                                 std::int64_t until, std::optional<double> duration_s = std::nullopt);

/// The same from the onset, to a sample, that explains most.
RunningHypothesis with_refined_onset(const Bank& bank, const History& history, const TestedSamples& samples,
                                     const RunningHypothesis& coarse);

/// A push with the duration that explains most up to the sample `until`: those of the bank are steps apart.
RunningHypothesis with_refined_duration(const Bank& bank, const History& history, std::int64_t until,
                                        const RunningHypothesis& coarse);

}  // namespace faultline
