// SPDX-License-Identifier: MIT
#include "lib/compare/warp.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace faultline {
namespace {

/// Penalty that prefers the straight step among equally good ones, so that rests do not stretch time.
constexpr double kDetour = 1e-6;

enum Step : std::uint8_t { both, only_first, only_second };

double distance(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return sum;
}

/// Returns the step into each pair (i, j) on the best path to it.
std::vector<Step> best_steps(const MotionSamples& first, const MotionSamples& second) {
  const std::size_t rows = first.size(), columns = second.size();
  std::vector<Step> steps(rows * columns);
  std::vector<double> before(columns, std::numeric_limits<double>::infinity()), now(columns);
  for (std::size_t i = 0; i < rows; ++i) {
    for (std::size_t j = 0; j < columns; ++j) {
      const double inf = std::numeric_limits<double>::infinity();
      const double straight = i && j ? before[j - 1] : i || j ? inf : 0.0;
      const double down = (i ? before[j] : inf) + kDetour, right = (j ? now[j - 1] : inf) + kDetour;
      const double least = std::min({straight, down, right});
      steps[i * columns + j] = least == straight ? both : least == down ? only_first : only_second;
      now[j] = least + distance(first[i], second[j]);
    }
    before.swap(now);
  }
  return steps;
}

}  // namespace

std::vector<double> warped_places(const MotionSamples& first, const MotionSamples& second) {
  std::vector<double> sum(first.size()), count(first.size());
  if (first.empty() || second.empty()) return sum;
  const std::vector<Step> steps = best_steps(first, second);
  std::size_t i = first.size() - 1, j = second.size() - 1;
  while (true) {
    sum[i] += static_cast<double>(j);
    count[i] += 1.0;
    if (i == 0 && j == 0) break;
    const Step step = steps[i * second.size() + j];
    if (step != only_second) --i;
    if (step != only_first) --j;
  }
  for (std::size_t k = 0; k < sum.size(); ++k) sum[k] /= count[k];
  return sum;
}

}  // namespace faultline
