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

}  // namespace faultline
