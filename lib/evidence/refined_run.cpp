// SPDX-License-Identifier: MIT
#include "lib/evidence/refined_run.hpp"

#include <algorithm>

namespace faultline {
namespace {

constexpr int kReach = 3;       // onsets tried on either side of the best,
constexpr int kFactor = 4;      // at spacings that shrink by this
constexpr int kOnsetTold = 64;  // samples after the trigger by which an onset has told all it does
// Times the duration: between a pulse of the bank and the next, coarsely and then finely.
constexpr double kCoarseDuration = 1.25, kFineDuration = 1.07;
constexpr int kDurations = 3;  // on either side

}  // namespace

RunningHypothesis run_hypothesis(const Bank& bank, const History& history, int hypothesis, std::int64_t onset,
                                 std::int64_t until, std::optional<double> duration_s) {
  RunningHypothesis running = bank.start(hypothesis, onset, history[onset - 1], history[onset], duration_s);
  for (std::int64_t k = onset + 1; k <= until; ++k) bank.advance(running, history[k - 1], history[k]);
  return running;
}

/// Onsets are held against each other by what a while after the trigger tells: what comes later tells them
/// apart no more.
RunningHypothesis with_refined_onset(const Bank& bank, const History& history, const TestedSamples& samples,
                                     const RunningHypothesis& coarse) {
  const std::int64_t until = std::min(samples.now, samples.trigger + kOnsetTold);
  auto run = [&](std::int64_t onset, std::int64_t to) {
    return run_hypothesis(bank, history, coarse.hypothesis, onset, to);
  };
  RunningHypothesis best = until == samples.now ? coarse : run(coarse.onset, until);
  const int distance = static_cast<int>(std::max<std::int64_t>(samples.trigger - coarse.onset, 1));
  for (int spacing = std::max(distance / kFactor, 1);; spacing /= kFactor) {
    const std::int64_t centre = best.onset;
    for (int k = -kReach; k <= kReach; ++k) {
      const std::int64_t onset = centre + k * spacing;
      if (k == 0 || onset < samples.earliest || onset > samples.trigger) continue;
      const RunningHypothesis candidate = run(onset, until);
      if (better(candidate, best)) best = candidate;
    }
    if (spacing == 1) break;
    spacing = std::max(spacing, kFactor);
  }
  if (until == samples.now || best.onset == coarse.onset) return until == samples.now ? best : coarse;
  const RunningHypothesis to_the_end = run(best.onset, samples.now);
  return better(to_the_end, coarse) ? to_the_end : coarse;
}

RunningHypothesis with_refined_duration(const Bank& bank, const History& history, std::int64_t until,
                                        const RunningHypothesis& coarse) {
  RunningHypothesis best = coarse;
  for (const double factor : {kCoarseDuration, kFineDuration}) {
    const double centre = best.duration_s;
    double longer = 1.0;
    for (int k = 0; k < kDurations; ++k) {
      longer *= factor;
      for (const double duration_s : {centre * longer, centre / longer}) {
        const RunningHypothesis candidate =
            run_hypothesis(bank, history, best.hypothesis, best.onset, until, duration_s);
        if (better(candidate, best)) best = candidate;
      }
    }
  }
  return best;
}

}  // namespace faultline
