// SPDX-License-Identifier: MIT
#include "lib/reproduce/runs/paired_bootstrap.hpp"

#include <limits>

#include "lib/core/random.hpp"
#include "lib/core/statistics.hpp"

namespace faultline {
namespace {

template <typename Value>
std::vector<double> of_each(const AlarmScore& score, const Value& value) {
  std::vector<double> values;
  for (const RunOutcome& outcome : score.outcomes) values.push_back(value(outcome));
  return values;
}

}  // namespace

PairedDifference paired_difference(std::span<const double> ours, std::span<const double> theirs,
                                   std::uint64_t seed, int draws) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const std::size_t runs = ours.size();
  if (runs == 0) return {kNan, kNan, kNan};
  Random random(seed);
  const auto count = static_cast<double>(runs);
  std::vector<double> means;
  for (int d = 0; d < draws; ++d) {
    double sum = 0.0;
    for (std::size_t i = 0; i < runs; ++i) {
      const std::uint64_t k = random.below(runs);
      sum += ours[k] - theirs[k];
    }
    means.push_back(sum / count);
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < runs; ++i) sum += ours[i] - theirs[i];
  return {sum / count, nearest_rank_quantile(means, 0.025), nearest_rank_quantile(means, 0.975)};
}

std::vector<double> delays_of(const AlarmScore& score, double missed_s) {
  return of_each(score, [&](const RunOutcome& o) { return o.detected ? o.delay_s : missed_s; });
}

std::vector<double> joints_right(const AlarmScore& score) {
  return of_each(score, [](const RunOutcome& o) { return o.right_joint ? 1.0 : 0.0; });
}

std::vector<double> kinds_right(const AlarmScore& score) {
  return of_each(score, [](const RunOutcome& o) { return o.right_kind ? 1.0 : 0.0; });
}

}  // namespace faultline
