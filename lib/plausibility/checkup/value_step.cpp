// SPDX-License-Identifier: MIT
#include "lib/plausibility/checkup/value_step.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace faultline {
namespace {

constexpr std::size_t kStepMostChanges = 4096;
constexpr std::size_t kFewestChanges = 30;
constexpr double kSingle = 1.5;  // changes below so many times the least one are a single step
constexpr std::ptrdiff_t kFewestSingle = 3;
constexpr double kFarthestMultiple = 50.0;  // beyond it the error of the step hides what is a multiple
constexpr double kOffMultiple = 0.15;       // of a step
constexpr double kMultiplesShare = 0.98;

}  // namespace

void ValueStep::add_change(double change) {
  if (change != 0.0 && changes_.size() < kStepMostChanges) changes_.push_back(std::abs(change));
}

std::optional<double> ValueStep::result() const {
  if (changes_.size() < kFewestChanges) return std::nullopt;
  std::vector<double> sizes = changes_;
  std::sort(sizes.begin(), sizes.end());
  const auto past = std::upper_bound(sizes.begin(), sizes.end(), kSingle * sizes.front());
  if (past - sizes.begin() < kFewestSingle) return std::nullopt;
  const double step = std::accumulate(sizes.begin(), past, 0.0) / static_cast<double>(past - sizes.begin());
  double judged = 0.0, multiples = 0.0;
  for (const double size : sizes) {
    const double steps = size / step;
    if (steps > kFarthestMultiple) break;
    judged += 1.0;
    multiples += std::abs(steps - std::round(steps)) < kOffMultiple ? 1.0 : 0.0;
  }
  if (judged < static_cast<double>(kFewestChanges) || multiples < kMultiplesShare * judged)
    return std::nullopt;
  return step;
}

}  // namespace faultline
