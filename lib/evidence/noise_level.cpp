// SPDX-License-Identifier: MIT
#include "lib/evidence/noise_level.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/core/statistics.hpp"

namespace faultline {
namespace {

constexpr int kBlockRows = 64;  // long enough for a mean square, short enough to lie between two moves
constexpr double kCalmestShare = 0.25;
constexpr double kMostSame = 0.2;         // of its rows
constexpr double kThird = 3.0;            // binomial weight
constexpr double kDifferenceGain = 20.0;  // a third difference has 1 + 9 + 9 + 1 times the variance

/// Many readings are the same, as those of a coarse sensor at rest: they do not tell its noise.
bool mostly_repeats(const std::vector<double>& x, int begin) {
  int same = 0;
  for (int k = begin + 1; k < begin + kBlockRows; ++k) same += x[k] == x[k - 1];
  return same > kMostSame * kBlockRows;
}

/// Mean square of the third differences of a block; NaN where they say nothing.
double block_jitter(const std::vector<double>& x, int begin) {
  double sum = 0.0;
  int count = 0;
  for (int k = begin + 3; k < begin + kBlockRows; ++k) {
    const double d = x[k] - x[k - 3] - kThird * (x[k - 1] - x[k - 2]);
    if (!std::isfinite(d)) continue;
    sum += d * d;
    ++count;
  }
  return count > 0 && sum > 0.0 ? sum / count : std::numeric_limits<double>::quiet_NaN();
}

double level_of(const std::vector<double>& x, bool skip_repeats) {
  std::vector<double> jitters;
  for (int begin = 0; begin + kBlockRows <= static_cast<int>(x.size()); begin += kBlockRows) {
    if (skip_repeats && mostly_repeats(x, begin)) continue;
    const double jitter = block_jitter(x, begin);
    if (std::isfinite(jitter)) jitters.push_back(jitter);
  }
  return jitters.empty() ? 0.0 : std::sqrt(lower_quantile(jitters, kCalmestShare) / kDifferenceGain);
}

std::vector<double> levels_of(const JointSignals& signals, bool skip_repeats) {
  std::vector<double> out;
  for (const auto& signal : signals) out.push_back(level_of(signal, skip_repeats));
  return out;
}

std::vector<double> root_mean_square(const std::vector<const std::vector<double>*>& lists) {
  std::vector<double> out;
  for (const std::vector<double>* list : lists) {
    if (out.size() < list->size()) out.resize(list->size(), 0.0);
  }
  for (std::size_t j = 0; j < out.size(); ++j) {
    double sum = 0.0;
    int count = 0;
    for (const std::vector<double>* list : lists) {
      if (j >= list->size() || (*list)[j] <= 0.0) continue;
      sum += (*list)[j] * (*list)[j];
      ++count;
    }
    out[j] = count > 0 ? std::sqrt(sum / count) : 0.0;
  }
  return out;
}

double scale_of(const std::vector<double>& usual, const std::vector<double>& level, std::size_t j,
                const std::array<double, 2>& bounds) {
  if (j >= usual.size() || j >= level.size() || usual[j] <= 0.0 || level[j] <= 0.0) return 1.0;
  return std::clamp(level[j] / usual[j], bounds[0], bounds[1]);
}

}  // namespace

NoiseLevel noise_level(const Log& log) { return {levels_of(log.q, true), levels_of(log.dq, false)}; }

NoiseLevel usual_level(const std::vector<NoiseLevel>& levels) {
  std::vector<const std::vector<double>*> q, dq;
  for (const NoiseLevel& level : levels) {
    q.push_back(&level.q);
    dq.push_back(&level.dq);
  }
  return {root_mean_square(q), root_mean_square(dq)};
}

LogNoise noise_against(const NoiseLevel& usual, const NoiseLevel& level,
                       const std::array<double, 2>& bounds) {
  LogNoise noise;
  for (std::size_t j = 0; j < kMaxJoints; ++j) {
    noise.q_scale[j] = scale_of(usual.q, level.q, j, bounds);
    noise.dq_scale[j] = scale_of(usual.dq, level.dq, j, bounds);
  }
  return noise;
}

}  // namespace faultline
