// SPDX-License-Identifier: MIT
#include "lib/cases/votes.hpp"

#include <algorithm>

namespace faultline {
namespace {

void vote(std::vector<LabelShare>& votes, const FaultLabel& label, double weight) {
  const auto known =
      std::find_if(votes.begin(), votes.end(), [&](const auto& v) { return v.label == label; });
  if (known != votes.end())
    known->share += weight;
  else
    votes.push_back({label, weight});
}

void vote_of_cases(std::vector<LabelShare>& votes, const std::vector<Neighbour>& near,
                   const VoteOptions& options) {
  for (const Neighbour& n : near)
    if (fault_is_known(*n.found))
      vote(votes, n.found->label,
           n.similarity * (n.found->outcome == CaseOutcome::unconfirmed ? options.unconfirmed_weight : 1.0));
}

/// Converts votes to shares of their sum, sorted by size; equal shares in the order of voting.
void normalise(std::vector<LabelShare>& votes) {
  double sum = 0.0;
  for (const LabelShare& v : votes) sum += v.share;
  if (sum > 0.0)
    for (LabelShare& v : votes) v.share /= sum;
  std::stable_sort(votes.begin(), votes.end(),
                   [](const auto& a, const auto& b) { return a.share > b.share; });
}

}  // namespace

std::vector<Neighbour> retrieve(const CaseBase& base, std::span<const double> features, int count,
                                double least_similarity) {
  std::vector<Neighbour> found;
  for (const Case& c : base.cases()) {
    const double s = similarity(base.metric(), features, c.episode.features);
    if (s > 0.0 && s >= least_similarity) found.push_back({&c, s});
  }
  const auto kept = found.begin() + std::clamp<std::ptrdiff_t>(count, 0, std::ssize(found));
  std::partial_sort(found.begin(), kept, found.end(), [](const Neighbour& a, const Neighbour& b) {
    return a.similarity != b.similarity ? a.similarity > b.similarity : a.found->id < b.found->id;
  });
  found.erase(kept, found.end());
  return found;
}

Votes votes_on(const Episode& episode, const CaseBase& base, const VoteOptions& options) {
  Votes votes;
  votes.precedents = retrieve(base, episode.features, options.neighbours, base.metric().near_similarity);
  vote(votes.shares, episode.mlp.label, options.opinion_weight * episode.mlp.confidence);
  vote(votes.shares, episode.rbfn.label, options.opinion_weight * episode.rbfn.confidence);
  vote_of_cases(votes.shares, votes.precedents, options);
  normalise(votes.shares);
  vote_of_cases(votes.of_cases, votes.precedents, options);
  normalise(votes.of_cases);
  return votes;
}

}  // namespace faultline
