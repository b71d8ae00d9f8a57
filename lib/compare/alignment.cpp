// SPDX-License-Identifier: MIT
#include "lib/compare/alignment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/compare/motion_pair.hpp"
#include "lib/compare/run_signals.hpp"

namespace faultline {
namespace {

constexpr double kBetter = 0.5;         // largest ratio of the differences with and without a shift or a warp
constexpr double kAgreesAWhile = 0.25;  // least `agreeing` by positions for runs that a fault separates
constexpr double kMoreAgreeing = 0.2;   // of the time: least gain by a shift for such runs
constexpr int kRefinements = 6;
constexpr double kLeastShift = 0.1;  // sample periods

/// Share of the rms speed below which a position determines no time.
constexpr double kSlow = 0.05;

constexpr int kFine = 20000;           // samples to refine a shift
constexpr std::size_t kRefined = 8;    // number of shifts to refine
constexpr double kNearlyAsGood = 4.0;  // largest ratio to the least cost, before refinement
constexpr double kAgreeing = 1e-4;     // squared distance of motions that agree, in variances of the motion

struct ShiftCost {
  double shift = 0.0, cost = 0.0;
};

/// Returns local minima of the cost over the shift that are not much worse than the best, smallest first.
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
  for (int i = 0; i < kRefinements; ++i, most /= 2.0) {
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

/// Returns the delay of the second run, s, to a fraction of a sample; differences beyond a tenth of the
/// motion have no more weight. For a periodic motion, the smallest of the equally good shifts.
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

MotionSamples sampled(const MotionPair& motions, const RunSignals& run, bool is_first, double step) {
  MotionSamples samples;
  for (double t = 0.0; t <= run.length_s; t += step) {
    std::vector<double> now = is_first ? motions.first_at(t) : motions.second_at(t);
    for (std::size_t j = 0; j < now.size(); ++j)
      if (std::isnan(now[j])) now[j] = samples.empty() ? 0.0 : samples.back()[j];
    samples.push_back(std::move(now));
  }
  return samples;
}

RunAlignment warp_of(const MotionPair& motions, const RunSignals& first, const RunSignals& second) {
  const double step = motions.coarse_step(), speed = motions.rms_speed();
  const auto places =
      warped_places(sampled(motions, first, true, step), sampled(motions, second, false, step));
  RunAlignment warp;
  warp.kind = AlignmentKind::motion;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double t = static_cast<double>(i) * step;
    double at = places[i] * step;
    for (int k = 0; k < kRefinements; ++k)
      if (const double c = motions.correction(t, at, kSlow * speed); std::abs(c) <= step) at += c;
    if (!warp.first_s.empty() && at <= warp.second_s.back()) continue;
    warp.first_s.push_back(t);
    warp.second_s.push_back(at);
  }
  warp.uncertain_s = speed > 0.0 ? motions.noise() / speed : 0.0;
  return warp;
}

std::string percent(double share) { return fmt::format("{:.2g} %", 100.0 * share); }

RunAlignment finished(RunAlignment alignment, const std::string& basis, double without, bool is_only_time) {
  const bool agrees = alignment.left_rms <= kSameMotion;
  alignment.same_motion = agrees || alignment.parts;
  const std::string left =
      agrees || !alignment.parts
          ? percent(alignment.left_rms) + " of the motion (rms)"
          : fmt::format("{:.0f} % of the motion in {:.0f} % of the time, and diverge then",
                        100.0 * kSameMotion, 100.0 * alignment.agreeing);
  if (!alignment.same_motion) {
    alignment.why = "at best alignment the " + basis + " still differ by " + left +
                    ", so the motions differ, not the robot";
  } else if (alignment.warped()) {
    const double first = alignment.first_s.back() - alignment.first_s.front();
    const double second = alignment.second_s.back() - alignment.second_s.front();
    alignment.why = fmt::format(
        "no constant shift fits, because the moves differ in duration (the second run takes {:.4g} times as "
        "long); times follow the {}, which then agree to {}, instead of {}",
        second / first, basis, left, percent(without));
  } else if (alignment.kind == AlignmentKind::motion) {
    alignment.why = fmt::format(
        "the {} agree to {} with the second run shifted {:.4f} s {}, and to {} without a shift", basis, left,
        std::abs(alignment.shift_s), alignment.shift_s >= 0 ? "later" : "earlier", percent(without));
  } else {
    alignment.why = "each run counts from its first row; the " + basis + " agree to " + left +
                    (is_only_time ? "" : ", and no shift improves that");
  }
  return alignment;
}

}  // namespace

const char* to_string(AlignmentKind kind) {
  switch (kind) {
    case AlignmentKind::automatic:
      return "auto";
    case AlignmentKind::time:
      return "time";
    case AlignmentKind::motion:
      return "motion";
  }
  return "";
}

double RunAlignment::second_at(double at) const {
  if (!warped()) return at + shift_s;
  if (at < first_s.front() || at > first_s.back()) return kNotKnown;
  const auto next =
      static_cast<std::size_t>(std::lower_bound(first_s.begin(), first_s.end(), at) - first_s.begin());
  if (next == 0) return second_s.front();
  const double share = (at - first_s[next - 1]) / (first_s[next] - first_s[next - 1]);
  return second_s[next - 1] + share * (second_s[next] - second_s[next - 1]);
}

double RunAlignment::rate_at(double at) const {
  if (!warped() || first_s.size() < 2) return 1.0;
  const auto found =
      static_cast<std::size_t>(std::lower_bound(first_s.begin(), first_s.end(), at) - first_s.begin());
  const std::size_t next = std::clamp<std::size_t>(found, 1, first_s.size() - 1);
  return (second_s[next] - second_s[next - 1]) / (first_s[next] - first_s[next - 1]);
}

RunAlignment align_runs(const RunSignals& first, const RunSignals& second, AlignmentKind wanted) {
  const MotionPair motions(first, second);
  const std::string basis = first.by_reference ? "references" : "positions (no references were recorded)";
  const double step = motions.coarse_step();
  RunAlignment plain;
  const auto judge = [&](RunAlignment& alignment) {
    const auto fit = motions.fit([&](double t) { return alignment.second_at(t); }, step);
    alignment.left_rms = fit.left_rms;
    alignment.agreeing = fit.agreeing;
    alignment.parts = !first.by_reference && alignment.agreeing >= kAgreesAWhile;
  };
  judge(plain);
  if (wanted == AlignmentKind::time) return finished(plain, basis, plain.left_rms, true);
  RunAlignment shifted;
  shifted.kind = AlignmentKind::motion;
  shifted.shift_s = best_shift(motions, first, second);
  judge(shifted);
  const bool shift_pays =
      (shifted.left_rms <= kBetter * plain.left_rms ||
       (shifted.parts && shifted.agreeing >= plain.agreeing + kMoreAgreeing)) &&
      std::abs(shifted.shift_s) >= kLeastShift * std::min(first.period_s, second.period_s);
  RunAlignment best = shift_pays || (wanted == AlignmentKind::motion && !(plain.left_rms < shifted.left_rms))
                          ? shifted
                          : plain;
  const bool may_warp = first.by_reference || wanted == AlignmentKind::motion;
  if (best.left_rms > kSameMotion && !best.parts && may_warp) {
    RunAlignment warp = warp_of(motions, first, second);
    judge(warp);
    warp.parts = false;
    if (warp.left_rms <= kSameMotion && warp.left_rms <= kBetter * best.left_rms) best = warp;
  }
  return finished(best, basis, plain.left_rms, false);
}

}  // namespace faultline
