// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "lib/cases/case_base.hpp"

namespace faultline {

/// A case and its similarity to the query episode. Points into its case base.
struct Neighbour {
  const Case* found = nullptr;
  double similarity = 0.0;  ///< 0 to 1
};

/// Returns the `count` most similar cases, the most similar first, with equal similarity the lower id first.
/// Fewer if the base is smaller; leaves out cases that cannot be compared (similarity 0) or are less similar
/// than `least_similarity`.
std::vector<Neighbour> retrieve(const CaseBase& base, std::span<const double> features, int count,
                                double least_similarity = 0.0);

struct VoteOptions {
  int neighbours = 7;           ///< cases that vote
  double opinion_weight = 1.0;  ///< a network's vote is this times its confidence; a case's, its similarity
  double unconfirmed_weight = 0.5;  ///< factor on the vote of a case that is neither confirmed nor rejected
};

struct LabelShare {
  FaultLabel label;
  double share = 0.0;  ///< 0 to 1
};

/// Votes of similar cases and networks on an episode.
struct Votes {
  std::vector<Neighbour> precedents;  ///< near cases, the most similar first; they point into the case base
  std::vector<LabelShare> shares;     ///< of precedents and networks, the largest first
  std::vector<LabelShare> of_cases;   ///< of the precedents alone, the largest first
};

/// Retrieves the cases near an episode and counts their votes by similarity, and those of the two networks by
/// confidence (reuse, in terms of case-based reasoning). Rejected cases of unknown fault have no vote. Does
/// not change the base.
Votes votes_on(const Episode& episode, const CaseBase& base, const VoteOptions& options = {});

}  // namespace faultline
