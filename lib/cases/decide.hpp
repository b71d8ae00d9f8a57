// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/cases/retrieve.hpp"

namespace faultline {

struct DecideOptions {
  int neighbours = 7;           ///< cases that vote
  double opinion_weight = 1.0;  ///< a network's vote is this times its confidence; a case's is its similarity
  double unconfirmed_weight = 0.5;  ///< what a case's vote counts while nobody has confirmed or rejected it
  double thin_evidence = 5.0;       ///< abstain below this log likelihood ratio
  double thin_confidence = 0.2;     ///< abstain when two agreeing networks are on average less sure than this
  double clear_share =
      0.5;  ///< disagreement is settled, or a warning given, by more than this share of votes
  double near_similarity = -1.0;  ///< below it a case is no precedent; negative = what the case base learned
};

enum class Settlement {
  agreement,  ///< the two networks agree
  cases,      ///< they disagree and similar cases settled it, or nothing was near and it is `unknown`
  abstained,  ///< the evidence is too thin, or the votes too even, to name a fault
};

/// A label and its share of all votes.
struct LabelShare {
  FaultLabel label;
  double share = 0.0;  ///< 0 to 1
};

struct CaseDecision {
  FaultLabel label;  ///< `unknown` at joint 0 when nothing recorded resembles the episode, or when abstained
  double confidence = 0.0;  ///< 0 to 1
  Settlement settled_by = Settlement::abstained;
  std::vector<Neighbour> precedents;  ///< near cases, the most similar first
  std::vector<LabelShare> shares;     ///< all that was voted for, the largest first
  std::string why;                    ///< one sentence for a person
  std::vector<std::string> warnings;  ///< what the cases hold against the decision
};

/// Case-based decision on one episode (the paper's "dual classification with robust decision", figure 2, at
/// the level of the episode): two networks that agree are believed and cases give precedents and warnings;
/// when they disagree, the neighbours' votes weighted by similarity together with the two opinions settle it;
/// with nothing near it is an unknown fault. The base is not changed; `precedents` point into it.
CaseDecision decide(const Episode& episode, const CaseBase& base, const DecideOptions& options = {});

}  // namespace faultline
