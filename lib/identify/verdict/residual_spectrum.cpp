// SPDX-License-Identifier: MIT
#include "lib/identify/verdict/residual_spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "lib/core/elementary/elementary.hpp"
#include "lib/core/statistics.hpp"

namespace faultline {
namespace {

constexpr std::size_t kSegment = 256;  // windows that one spectrum is made of; each half over the last
constexpr std::size_t kShortest = 64;  // of a log that has fewer: this many at least
constexpr double kSpectrumGap = 1.5;   // times the usual step between windows is a gap

/// Usual time from one window to the next in the same log.
double usual_step(const JointFit& fit) {
  std::vector<double> steps;
  for (std::size_t k = 1; k < fit.size(); ++k)
    if (fit.log[k] == fit.log[k - 1]) steps.push_back(fit.time_s[k] - fit.time_s[k - 1]);
  return steps.empty() ? 0.0 : upper_median(std::move(steps));
}

/// Begins and ends of windows without a gap.
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

/// Adds the power of one segment at every frequency: the square of a sine's rms.
void add_segment(std::span<const double> values, std::vector<double>& power) {
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
}

}  // namespace

void add_spectrum(const JointFit& fit, ResidualPattern& pattern) {
  const double step_s = usual_step(fit);
  const auto runs = runs_of(fit, step_s);
  std::size_t longest = 0, segments = 0;
  for (const auto& [begin, end] : runs) longest = std::max(longest, end - begin);
  const std::size_t length = std::min(kSegment, longest);
  if (length < kShortest || !(step_s > 0.0)) return;
  std::vector<double> left(fit.size()), power(length / 2 - 1, 0.0);
  for (std::size_t k = 0; k < fit.size(); ++k) left[k] = fit.residual(k);
  for (const auto& [begin, end] : runs)
    for (std::size_t at = begin; at + length <= end; at += length / 2, ++segments)
      add_segment(std::span(left).subspan(at, length), power);
  for (std::size_t f = 0; f < power.size(); ++f) {
    pattern.spectrum_hz.push_back(static_cast<double>(f + 1) / (static_cast<double>(length) * step_s));
    pattern.spectrum.push_back(std::sqrt(power[f] / static_cast<double>(segments)));
  }
}

}  // namespace faultline
