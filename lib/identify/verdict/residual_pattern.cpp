// SPDX-License-Identifier: MIT
#include "lib/identify/verdict/residual_pattern.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "lib/core/elementary/elementary.hpp"
#include "lib/core/statistics.hpp"

namespace faultline {
namespace {

constexpr int kBins = 24;  // bins of equal count (8 windows at least), by position, speed or torque
constexpr std::size_t kPatternFewest = 200;  // least number of windows or pairs
constexpr double kHalf_s = 2.0;              // length of the stretches, alternately fitted and judged
constexpr double kSameWindow = 1e-6;         // of a window's length: tolerance of its start
constexpr double kLatestWindows = 2.0;       // window lengths beyond which nothing is "previous"

constexpr std::size_t kSegment = 256;  // windows of one spectrum; each overlaps half of the previous one
constexpr std::size_t kShortest = 64;  // least windows of one spectrum, if the longest log has fewer
constexpr double kSpectrumGap = 1.5;   // times the usual step between windows: longer is a gap

struct Sample {
  double key = 0.0, value = 0.0;
  int half = 0;
};

/// Assigns samples to bins of equal count, by rank.
std::vector<int> bins_by_rank(const std::vector<Sample>& samples) {
  std::vector<std::size_t> order(samples.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return samples[a].key < samples[b].key; });
  std::vector<int> bin(samples.size());
  for (std::size_t i = 0; i < order.size(); ++i) bin[order[i]] = static_cast<int>(i * kBins / order.size());
  return bin;
}

/// Returns the share of the values' variance that the means of the other half's bins explain.
double share_explained(const std::vector<Sample>& samples) {
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
    const double predicted = count[other][bin[i]] > 0.0 ? sum[other][bin[i]] / count[other][bin[i]] : mean;
    left += (samples[i].value - predicted) * (samples[i].value - predicted);
    square += (samples[i].value - mean) * (samples[i].value - mean);
  }
  return square > 0.0 ? std::max(1.0 - left / square, 0.0) : std::numeric_limits<double>::quiet_NaN();
}

double explained_by(const JointFit& fit, const std::vector<double>& key) {
  std::vector<Sample> samples;
  for (std::size_t k = 0; k < fit.size(); ++k)
    if (fit.moving[k])
      samples.push_back({key[k], fit.residual(k), static_cast<int>(std::floor(fit.time_s[k] / kHalf_s)) & 1});
  return samples.size() < kPatternFewest ? std::numeric_limits<double>::quiet_NaN()
                                         : share_explained(samples);
}

/// Returns the squared correlation with the value one window earlier in the same log.
double explained_by_previous(const JointFit& fit) {
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

/// Returns the median time from one window to the next in the same log.
double usual_step(const JointFit& fit) {
  std::vector<double> steps;
  for (std::size_t k = 1; k < fit.size(); ++k)
    if (fit.log[k] == fit.log[k - 1]) steps.push_back(fit.time_s[k] - fit.time_s[k - 1]);
  return steps.empty() ? 0.0 : upper_median(std::move(steps));
}

/// Returns begin and end of each run of windows without a gap.
std::vector<std::pair<std::size_t, std::size_t>> runs_of(const JointFit& fit, double step_s) {
  std::vector<std::pair<std::size_t, std::size_t>> runs;
  for (std::size_t begin = 0, k = 1; k <= fit.size(); ++k) {
    const bool same = k < fit.size() && fit.log[k] == fit.log[begin] &&
                      fit.time_s[k] - fit.time_s[k - 1] < kSpectrumGap * step_s;
    if (same) continue;
    runs.emplace_back(begin, k);
    begin = k;
  }
  return runs;
}

/// Returns the power with that of one more segment at every frequency: the squared rms of a sine.
std::vector<double> with_segment(std::span<const double> values, std::vector<double> power) {
  const std::size_t n = values.size();
  double mean = 0.0, norm = 0.0;
  for (const double v : values) mean += v / static_cast<double>(n);
  std::vector<double> tapered(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double x = (static_cast<double>(i) + 0.5) / static_cast<double>(n);
    const double arch = elementary::sin(std::numbers::pi * x), taper = arch * arch;
    tapered[i] = taper * (values[i] - mean);
    norm += taper * taper;
  }
  for (std::size_t f = 0; f < power.size(); ++f) {
    const double rate = 2.0 * std::numbers::pi * static_cast<double>(f + 1) / static_cast<double>(n);
    double c = 0.0, s = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      const auto [sine, cosine] = elementary::sin_cos(rate * static_cast<double>(i));
      c += tapered[i] * cosine;
      s += tapered[i] * sine;
    }
    power[f] += 2.0 * (c * c + s * s) / (norm * static_cast<double>(n));
  }
  return power;
}

/// Rms in the band of each frequency.
struct Spectrum {
  std::vector<double> hz, rms;
};

/// Returns the spectrum of the residual, up to the highest frequency that half-overlapping windows show: the
/// mean power of stretches of some seconds under a Hann taper (Welch 1967). Windows are averages, so it falls
/// off towards 1 / window. Empty if no log is long enough.
Spectrum spectrum_of(const JointFit& fit) {
  Spectrum out;
  const double step_s = usual_step(fit);
  const auto runs = runs_of(fit, step_s);
  std::size_t longest = 0, segments = 0;
  for (const auto& [begin, end] : runs) longest = std::max(longest, end - begin);
  const std::size_t length = std::min(kSegment, longest);
  if (length < kShortest || !(step_s > 0.0)) return out;
  std::vector<double> left(fit.size()), power(length / 2 - 1, 0.0);
  for (std::size_t k = 0; k < fit.size(); ++k) left[k] = fit.residual(k);
  for (const auto& [begin, end] : runs)
    for (std::size_t at = begin; at + length <= end; at += length / 2, ++segments)
      power = with_segment(std::span(left).subspan(at, length), std::move(power));
  for (std::size_t f = 0; f < power.size(); ++f) {
    out.hz.push_back(static_cast<double>(f + 1) / (static_cast<double>(length) * step_s));
    out.rms.push_back(std::sqrt(power[f] / static_cast<double>(segments)));
  }
  return out;
}

}  // namespace

ResidualPattern residual_pattern(const JointFit& fit) {
  Spectrum spectrum = spectrum_of(fit);
  return {explained_by(fit, fit.q),   explained_by(fit, fit.dq), explained_by(fit, fit.modelled),
          explained_by_previous(fit), std::move(spectrum.hz),    std::move(spectrum.rms)};
}

}  // namespace faultline
