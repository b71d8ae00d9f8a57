// SPDX-License-Identifier: MIT
#include "lib/evidence/evidence_trace.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/evidence/bank.hpp"
#include "lib/evidence/filter/history.hpp"

namespace faultline {
namespace {

constexpr std::size_t kTracedLabels = 4;
constexpr std::int64_t kTracedSamples = 120;

/// The best hypothesis of each label, the likeliest first, as many as are traced.
std::vector<const RunningHypothesis*> best_of_labels(const Bank& bank,
                                                     const std::vector<RunningHypothesis>& best) {
  std::vector<const RunningHypothesis*> order;
  for (const RunningHypothesis& running : best)
    if (std::isfinite(running.log_likelihood_ratio) && !is_healthy(bank.hypotheses()[running.hypothesis]))
      order.push_back(&running);
  std::stable_sort(order.begin(), order.end(), [](const auto* a, const auto* b) {
    return a->log_likelihood_ratio > b->log_likelihood_ratio;
  });
  std::vector<const RunningHypothesis*> kept;
  auto label_of = [&](const RunningHypothesis* r) { return bank.hypotheses()[r->hypothesis].label; };
  for (const RunningHypothesis* candidate : order) {
    const bool seen = std::any_of(kept.begin(), kept.end(),
                                  [&](const auto* k) { return label_of(k) == label_of(candidate); });
    if (!seen && kept.size() < kTracedLabels) kept.push_back(candidate);
  }
  return kept;
}

}  // namespace

EvidenceTrace trace_evidence(const Bank& bank, const History& history,
                             const std::vector<RunningHypothesis>& best, std::int64_t now) {
  EvidenceTrace trace;
  const std::vector<const RunningHypothesis*> traced = best_of_labels(bank, best);
  std::int64_t first = now;
  for (const RunningHypothesis* running : traced) first = std::min(first, running->onset);
  const std::int64_t stride = (now - first) / kTracedSamples + 1;
  auto is_noted = [&](std::int64_t k) { return (now - k) % stride == 0; };
  for (std::int64_t k = first; k <= now; ++k)
    if (is_noted(k)) trace.time.push_back(history[k].time);
  for (const RunningHypothesis* end : traced) {
    EvidenceCurve curve{bank.hypotheses()[end->hypothesis].label, {}};
    for (std::int64_t k = first; k < end->onset; ++k)
      if (is_noted(k)) curve.ratio.push_back(std::numeric_limits<double>::quiet_NaN());
    RunningHypothesis running =
        bank.start(end->hypothesis, end->onset, history[end->onset - 1], history[end->onset]);
    for (std::int64_t k = end->onset;; bank.advance(running, history[k - 1], history[k])) {
      if (is_noted(k)) curve.ratio.push_back(running.log_likelihood_ratio);
      if (++k > now) break;
    }
    trace.curves.push_back(std::move(curve));
  }
  return trace;
}

}  // namespace faultline
