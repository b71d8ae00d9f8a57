// SPDX-License-Identifier: MIT
#include "lib/compare/best_shift.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace faultline {
namespace {

constexpr int kFine = 20000;  // samples when it is refined
constexpr int kShiftRefinements = 6;
constexpr std::size_t kRefined = 8;    // shifts that are refined
constexpr double kNearlyAsGood = 4.0;  // as the best, before they are
constexpr double kAgreeing = 1e-4;     // squared distance, in shares of the motion, of motions that agree

/// A shift and its cost.
struct ShiftCost {
  double shift = 0.0, cost = 0.0;
};

/// Shifts that are better than those beside them and not much worse than the best, smallest first.
std::vector<ShiftCost> likely_shifts(const MotionPair& motions, const RunSignals& first,
                                     const RunSignals& second) {
  const double step = motions.coarse_step();
  const double most = std::max(first.length_s, second.length_s) * kLeastOverlap;
  const auto steps = static_cast<int>(most / step);
  std::vector<ShiftCost> all, likely;
  for (int i = -steps; i <= steps; ++i) all.push_back({i * step, motions.cost(i * step, 3.0 * step)});
  double least = std::numeric_limits<double>::infinity();
  for (const ShiftCost& one : all) least = std::min(least, one.cost);
  for (std::size_t i = 1; i + 1 < all.size(); ++i)
    if (all[i].cost <= std::max(kNearlyAsGood * least, kAgreeing) && all[i].cost <= all[i - 1].cost &&
        all[i].cost <= all[i + 1].cost)
      likely.push_back(all[i]);
  std::stable_sort(likely.begin(), likely.end(), [](const ShiftCost& a, const ShiftCost& b) {
    return std::abs(a.shift) < std::abs(b.shift);
  });
  likely.resize(std::min(likely.size(), kRefined));
  return likely;
}

double refined_shift(const MotionPair& motions, const RunSignals& first, double shift, double step) {
  const double slow = kSlow * motions.rms_speed();
  const double fine = std::max(first.period_s, first.length_s / kFine);
  double most = 2.0 * step;
  for (int i = 0; i < kShiftRefinements; ++i, most /= 2.0) {
    std::vector<double> corrections;
    for (double t = 0.0; t <= first.length_s; t += fine)
      if (const double c = motions.correction(t, t + shift, slow); std::abs(c) <= most)
        corrections.push_back(c);
    if (corrections.empty()) break;
    std::nth_element(corrections.begin(), corrections.begin() + corrections.size() / 2, corrections.end());
    shift += corrections[corrections.size() / 2];
  }
  return shift;
}

}  // namespace

double best_shift(const MotionPair& motions, const RunSignals& first, const RunSignals& second) {
  const double step = motions.coarse_step();
  std::vector<ShiftCost> refined;
  double least = std::numeric_limits<double>::infinity();
  for (const ShiftCost& likely : likely_shifts(motions, first, second)) {
    const double shift = refined_shift(motions, first, likely.shift, step);
    refined.push_back({shift, motions.cost(shift, 3.0 * step)});
    least = std::min(least, refined.back().cost);
  }
  for (const ShiftCost& one : refined)
    if (one.cost <= 2.0 * least + kAgreeing * kOutlier) return one.shift;
  return 0.0;
}

}  // namespace faultline
