// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/cases/retrieve.hpp"

namespace faultline {

struct VoteOptions {
  int neighbours = 7;           ///< cases that vote
  double opinion_weight = 1.0;  ///< a network's vote is this times its confidence; a case's is its similarity
  double unconfirmed_weight = 0.5;  ///< what a case's vote counts while nobody has confirmed or rejected it
  double near_similarity = -1.0;  ///< below it a case is no precedent; negative = what the case base learned
};

/// A label and its share of all votes.
struct LabelShare {
  FaultLabel label;
  double share = 0.0;  ///< 0 to 1
};

/// What similar cases say of an episode.
struct Votes {
  std::vector<Neighbour> precedents;  ///< near cases, the most similar first; they point into the case base
  std::vector<LabelShare> shares;     ///< of precedents and networks, the largest first
  std::vector<LabelShare> of_cases;   ///< of the precedents alone, the largest first
};

/// Retrieves the cases near an episode and lets them vote, each by its similarity, beside the two networks,
/// each by its confidence (reuse, in terms of case-based reasoning). Rejected cases whose fault nobody knows
/// have no vote. The base is not changed.
Votes votes_on(const Episode& episode, const CaseBase& base, const VoteOptions& options = {});

}  // namespace faultline
