// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "lib/explain/coarse/coarse_judge.hpp"

namespace faultline {

/// A guess whose onset stands out for its kind and joint.
struct CoarseCandidate {
  CoarseGuess guess;   ///< with the size that fits best
  int sample = 0;      ///< of the onset
  double score = 0.0;  ///< nats, by the gains of the healthy filter: only for the choice of onsets
};

struct CoarseSearch {
  std::vector<CoarseCandidate> candidates;  ///< best first; at most two of each kind, joint and length
  std::vector<int> onsets;                  ///< samples to try for every kind, most promising first
};

/// What a search at onsets 1 s apart finds.
struct RoughSearch {
  /// A search is worthwhile: a fault is likely, or the healthy robot does not explain some successive
  /// samples.
  bool stands_out = false;
  std::optional<CoarseCandidate> nearest{};  ///< the best candidate, if none stands out
};
RoughSearch search_roughly(const CoarseLog& log);

/// Searches onsets at distances of 0.05 s (at least a sample) for every kind that is a column: about the
/// healthy trajectory, by the gains of a filter that tolerates small errors.
CoarseSearch search_coarse(const CoarseLog& log);

/// Returns the first sample that no noise of the healthy robot explains, if there is one.
std::optional<int> first_strike(const CoarseLog& log);

}  // namespace faultline
