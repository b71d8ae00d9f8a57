// SPDX-License-Identifier: MIT
#include "lib/compare/motion_pair.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "lib/compare/run_signals.hpp"

namespace faultline {
namespace {

constexpr int kCoarse = 1200;          // samples for the first search of the shift
constexpr double kLeastSpread = 1e-9;  // rad or m, so that a constant joint causes no division by 0

double spread(const std::vector<double>& values) {
  double sum = 0.0, squares = 0.0, count = 0.0;
  for (const double v : values)
    if (std::isfinite(v)) sum += v, squares += v * v, count += 1.0;
  return count > 0.0 ? std::sqrt(std::max(squares / count - sum / count * (sum / count), 0.0)) : 0.0;
}

/// Penalty that prefers the straight step among equally good ones, so that rests do not stretch time.
constexpr double kDetour = 1e-6;

enum Step : std::uint8_t { both, only_first, only_second };

/// Returns the sum of squared differences.
double squared_distance(const std::vector<double>& a, const std::vector<double>& b) {
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
      now[j] = least + squared_distance(first[i], second[j]);
    }
    before.swap(now);
  }
  return steps;
}

}  // namespace

MotionPair::MotionPair(const RunSignals& first, const RunSignals& second) : first_(first), second_(second) {
  for (const RunSignal& signal : first.motion)
    scale_.push_back(1.0 / std::max(spread(signal.values), kLeastSpread));
}

MotionPair::Fit MotionPair::fit(const std::function<double(double)>& times, double step) const {
  double squares = 0.0, agree = 0.0, count = 0.0;
  for (double t = 0.0; t <= first_.length_s; t += step) {
    const double d = squared(first_at(t), second_at(times(t)));
    if (std::isnan(d)) continue;
    squares += std::min(d, 1.0);
    agree += d <= kSameMotion * kSameMotion;
    count += 1.0;
  }
  if (count == 0.0) return {kNotKnown, 0.0};
  return {std::sqrt(squares / count), agree / count};
}

double MotionPair::cost(double shift, double step) const {
  double sum = 0.0, count = 0.0;
  for (double t = std::max(0.0, -shift); t <= first_.length_s; t += step) {
    const double d = squared(first_at(t), second_at(t + shift));
    if (std::isnan(d)) continue;
    sum += std::min(d, kOutlier);
    count += 1.0;
  }
  const double shorter = std::min(first_.length_s, second_.length_s);
  return count * step < kLeastOverlap * shorter ? std::numeric_limits<double>::infinity() : sum / count;
}

double MotionPair::squared(const std::vector<double>& a, const std::vector<double>& b) {
  return squared_distance(a, b) / static_cast<double>(a.size());
}

double MotionPair::correction(double t, double at, double slow) const {
  const double h = 0.5 * second_.period_s;
  const auto a = first_at(t), b = second_at(at), before = second_at(at - h), after = second_at(at + h);
  double over = 0.0, under = 0.0;
  for (std::size_t j = 0; j < a.size(); ++j) {
    const double speed = (after[j] - before[j]) / (2.0 * h);
    over += speed * (a[j] - b[j]);
    under += speed * speed;
  }
  return std::sqrt(under) > slow ? over / under : kNotKnown;
}

double MotionPair::rms_speed() const {
  double sum = 0.0, count = 0.0;
  const double step = first_.length_s / kCoarse;
  for (double t = step; t <= first_.length_s; t += step) {
    const double d = squared(first_at(t), first_at(t - step));
    if (!std::isnan(d)) sum += d, count += 1.0;
  }
  return count > 0.0 ? std::sqrt(sum / count * static_cast<double>(scale_.size())) / step : 0.0;
}

double MotionPair::noise() const {
  double sum = 0.0;
  for (std::size_t j = 0; j < scale_.size(); ++j)
    for (const RunSignals* run : {&first_, &second_}) {
      const double one = scale_[j] * noise_of(run->motion[j].values);
      sum += one * one;
    }
  return std::sqrt(sum / static_cast<double>(scale_.size()));
}

std::vector<double> MotionPair::at(const RunSignals& run, double t) const {
  std::vector<double> values;
  for (std::size_t j = 0; j < scale_.size(); ++j)
    values.push_back(
        scale_[j] *
        value_between(run.motion[j].time, run.motion[j].values, t, kGapPeriods * run.period_s).value);
  return values;
}

double MotionPair::coarse_step() const {
  const double longer = std::max(first_.length_s, second_.length_s);
  return std::max(longer / kCoarse, std::max(first_.period_s, second_.period_s));
}

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
