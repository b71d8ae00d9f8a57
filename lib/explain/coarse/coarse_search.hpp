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
  double score = 0.0;  ///< nats, through the gains of the healthy filter: for the choice of onsets only
};

struct CoarseSearch {
  std::vector<CoarseCandidate> candidates;  ///< best first; at most two of each kind, joint and length
  std::vector<int> onsets;                  ///< samples worth trying for every kind, most telling first
};

/// Whether anything is worth searching for: a fault that stays, from about any second on, or some samples in
/// a row that the healthy robot does not explain.
bool stands_out(const CoarseLog& log);

/// Every sample as an onset of every kind that is a column: along the healthy trajectory, through the gains
/// of a filter that forgives some.
CoarseSearch search_coarse(const CoarseLog& log);

/// The first sample from which the healthy robot surely does not explain the log, if there is one.
std::optional<int> first_strike(const CoarseLog& log);

}  // namespace faultline
