// SPDX-License-Identifier: MIT
#include "lib/core/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace faultline {
namespace {

/// Returns the value with `rank` values before it, at most the largest.
double ranked(std::span<double> values, double rank) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const std::size_t at = std::min(static_cast<std::size_t>(std::max(rank, 0.0)), values.size() - 1);
  const auto found = values.begin() + static_cast<std::ptrdiff_t>(at);
  std::nth_element(values.begin(), found, values.end());
  return *found;
}

}  // namespace

double upper_median_of(std::span<double> values) {
  return ranked(values, static_cast<double>(values.size() / 2));
}

double upper_median(std::vector<double> values) { return upper_median_of(values); }

double upper_quantile(std::vector<double> values, double share) {
  return ranked(values, share * static_cast<double>(values.size()));
}

double lower_quantile(std::vector<double> values, double share) {
  return ranked(values, share * (static_cast<double>(values.size()) - 1.0));
}

double nearest_rank_quantile(std::vector<double> values, double share) {
  return ranked(values, std::ceil(share * static_cast<double>(values.size())) - 1.0);
}

}  // namespace faultline
