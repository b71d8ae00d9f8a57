// SPDX-License-Identifier: MIT
#include "lib/diagnose/stop/stop_signs.hpp"

#include <algorithm>
#include <cmath>

#include "lib/core/elementary/elementary.hpp"

namespace faultline {
namespace {

/// Limits at which a sum of evidence stops to grow, so that it falls to 0 soon after a deviation has ended.
constexpr double kMostLimits = 2.0;

/// Returns the sums that reach the limit if a row costs `nats`.
std::vector<Deviation> sums_above(const BalanceCourse& course, int j, double limit, double nats) {
  std::vector<Deviation> out;
  Deviation now;
  double sum = 0.0;
  bool reached = false;
  const auto close = [&] {
    if (reached) out.push_back(now);
    reached = false;
    sum = 0.0;
  };
  for (std::size_t k = 0; k < course.time_s.size(); ++k) {
    const double square = course.square(static_cast<Eigen::Index>(k), j);
    if (!std::isfinite(square)) continue;
    const double gain = 0.5 * square - nats;
    if (sum == 0.0 && gain > 0.0) now.start_s = course.time_s[k];
    if (gain > 0.0) now.last_s = course.time_s[k];
    sum = std::min(sum + gain, kMostLimits * limit);
    reached = reached || sum >= limit;
    if (sum <= 0.0) close();
  }
  close();
  return out;
}

}  // namespace

std::vector<Deviation> balance_deviations(const BalanceCourse& course, int j, double limit) {
  std::vector<Deviation> out = sums_above(course, j, limit, kNatsOfHealthyRow);
  const std::vector<Deviation> strong = sums_above(course, j, limit, kNatsOfAnyHealthyRow);
  for (Deviation& deviation : out) {
    const auto first = std::find_if(strong.begin(), strong.end(), [&](const Deviation& other) {
      return other.start_s >= deviation.start_s && other.start_s <= deviation.last_s;
    });
    if (first != strong.end()) deviation.start_s = first->start_s;
  }
  return out;
}

int samples_by_chance(int samples, int patterns, double chance) {
  const double mean = static_cast<double>(samples) / (static_cast<double>(patterns) + 1.0);
  double term = elementary::exp(-mean), below = term;  // probability of exactly, and at most, `count`
  int count = 0;
  while (1.0 - below > chance && count < samples) {
    ++count;
    term *= mean / count;
    below += term;
  }
  return count + 1;
}

std::vector<Deviation> sample_deviations(const std::vector<double>& time_s,
                                         const std::vector<double>& magnitude, double largest, int block,
                                         int enough) {
  std::vector<Deviation> out;
  const auto rows = static_cast<std::ptrdiff_t>(time_s.size());
  std::ptrdiff_t end_of_last = -1;
  for (std::ptrdiff_t begin = rows % block; begin + block <= rows; begin += block) {
    std::ptrdiff_t first = -1, last = -1;
    int count = 0;
    for (std::ptrdiff_t k = begin; k < begin + block; ++k) {
      if (!(magnitude[k] > largest)) continue;
      if (first < 0) first = k;
      last = k;
      ++count;
    }
    if (count < enough) continue;
    if (end_of_last == begin)
      out.back().last_s = time_s[last];
    else
      out.push_back({time_s[first], time_s[last]});
    end_of_last = begin + block;
  }
  return out;
}

std::optional<Deviation> lasting_deviation(const std::vector<Deviation>& deviations, double stop_s,
                                           double moment_s) {
  if (deviations.empty() || deviations.back().last_s < stop_s - moment_s) return std::nullopt;
  Deviation out = deviations.back();
  for (auto before = deviations.rbegin() + 1; before != deviations.rend(); ++before) {
    if (out.start_s - before->last_s > kSignPause_s) break;
    out.start_s = before->start_s;
  }
  return out;
}

}  // namespace faultline
