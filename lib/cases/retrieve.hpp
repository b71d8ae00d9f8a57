// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "lib/cases/case_base.hpp"

namespace faultline {

/// A case and how much it resembles the episode asked for. Points into the case base it came from.
struct Neighbour {
  const Case* found = nullptr;
  double similarity = 0.0;  ///< 0 to 1
};

/// The `count` most similar cases, the most similar first; among equals the lower id. Fewer when the base is
/// smaller; cases with nothing to compare (similarity 0) or less similar than `least_similarity` are left
/// out.
std::vector<Neighbour> retrieve(const CaseBase& base, std::span<const double> features, int count,
                                double least_similarity = 0.0);

}  // namespace faultline
