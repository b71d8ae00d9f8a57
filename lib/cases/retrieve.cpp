// SPDX-License-Identifier: MIT
#include "lib/cases/retrieve.hpp"

#include <algorithm>

namespace faultline {

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

}  // namespace faultline
