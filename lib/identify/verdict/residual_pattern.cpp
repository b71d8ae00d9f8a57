// SPDX-License-Identifier: MIT
#include "lib/identify/verdict/residual_pattern.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "lib/identify/verdict/residual_spectrum.hpp"

namespace faultline {
namespace {

constexpr int kBins = 24;  // of as many windows each (8 at least), by position, speed or torque
constexpr std::size_t kPatternFewest = 200;  // windows
constexpr double kHalf_s = 2.0;              // stretches of time that take turns
constexpr double kSameWindow = 1e-6;         // of a window's length
constexpr double kLatestWindows = 2.0;       // lengths of a window before which nothing is "previous"

struct Sample {
  double key = 0.0, value = 0.0;
  int half = 0;
};

/// Bins of as many samples each, by rank.
std::vector<int> bins_by_rank(const std::vector<Sample>& samples) {
  std::vector<std::size_t> order(samples.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return samples[a].key < samples[b].key; });
  std::vector<int> bin(samples.size());
  for (std::size_t i = 0; i < order.size(); ++i) bin[order[i]] = static_cast<int>(i * kBins / order.size());
  return bin;
}

/// Share of the values' variance that the means of the other half's bins tell.
double share_told(const std::vector<Sample>& samples) {
  const std::vector<int> bin = bins_by_rank(samples);
  std::array<std::array<double, kBins>, 2> sum{}, count{};
  double total = 0.0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    sum[samples[i].half][bin[i]] += samples[i].value;
    count[samples[i].half][bin[i]] += 1.0;
    total += samples[i].value;
  }
  const double mean = total / static_cast<double>(samples.size());
  double left = 0.0, square = 0.0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const int other = 1 - samples[i].half;
    const double told = count[other][bin[i]] > 0.0 ? sum[other][bin[i]] / count[other][bin[i]] : mean;
    left += (samples[i].value - told) * (samples[i].value - told);
    square += (samples[i].value - mean) * (samples[i].value - mean);
  }
  return square > 0.0 ? std::max(1.0 - left / square, 0.0) : std::numeric_limits<double>::quiet_NaN();
}

double told_by(const JointFit& fit, const std::vector<double>& key) {
  std::vector<Sample> samples;
  for (std::size_t k = 0; k < fit.size(); ++k)
    if (fit.moving[k])
      samples.push_back({key[k], fit.residual(k), static_cast<int>(std::floor(fit.time_s[k] / kHalf_s)) & 1});
  return samples.size() < kPatternFewest ? std::numeric_limits<double>::quiet_NaN() : share_told(samples);
}

/// Squared correlation with the value one window earlier in the same log.
double told_by_previous(const JointFit& fit) {
  double xx = 0.0, xy = 0.0, yy = 0.0;
  std::size_t pairs = 0, before = 0;
  for (std::size_t k = 0; k < fit.size(); ++k) {
    const double latest = fit.time_s[k] - fit.window_s * (1.0 - kSameWindow);
    while (before < k &&
           (fit.log[before] != fit.log[k] || (before + 1 < k && fit.time_s[before + 1] <= latest)))
      ++before;
    const double ago = fit.time_s[k] - fit.time_s[before];
    if (before == k || fit.time_s[before] > latest || ago > kLatestWindows * fit.window_s) continue;
    if (!fit.moving[before] || !fit.moving[k]) continue;
    const double x = fit.residual(before), y = fit.residual(k);
    xx += x * x, xy += x * y, yy += y * y;
    ++pairs;
  }
  return pairs < kPatternFewest || !(xx * yy > 0.0) ? std::numeric_limits<double>::quiet_NaN()
                                                    : xy * xy / (xx * yy);
}

}  // namespace

ResidualPattern residual_pattern(const JointFit& fit) {
  ResidualPattern out{
      told_by(fit, fit.q), told_by(fit, fit.dq), told_by(fit, fit.modelled), told_by_previous(fit), {}, {}};
  add_spectrum(fit, out);
  return out;
}

}  // namespace faultline
