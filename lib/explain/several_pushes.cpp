// SPDX-License-Identifier: MIT
#include "lib/explain/several_pushes.hpp"

#include <algorithm>
#include <functional>
#include <optional>
#include <utility>

#include "lib/explain/fault_spans.hpp"
#include "lib/explain/refine.hpp"
#include "lib/explain/search/search.hpp"

namespace faultline {
namespace {

constexpr std::size_t kPushesTried = 3;  // onsets that stand out, of which each is judged

/// Returns the best push beside the known faults of the log, if its evidence exceeds the limit.
std::optional<ExplainedFault> next_push(const LogFit& fit, const EvidenceLimits& limits) {
  std::vector<Candidate> found = search(fit);
  std::erase_if(found, [](const Candidate& c) { return c.kind != FaultKind::collision; });
  std::ranges::stable_sort(found, std::ranges::greater{}, &Candidate::score);
  if (found.size() > kPushesTried) found.resize(kPushesTried);
  JudgedHypotheses bench{fit};
  for (const Candidate& c : found) bench.go(c);
  std::vector<FaultHypothesis> best = best_of_each(bench.judged);
  if (best.empty() || best.front().gain <= kStandsOut) return std::nullopt;
  refine(best.front(), bench);
  best = best_of_each(bench.judged);
  best.resize(1);
  LogExplanation e{.best = std::move(best), .free_form = free_form(fit)};
  std::vector<ExplainedFault> named = named_faults(with_evidence(fit, std::move(e)), limits, 1);
  if (named.empty()) return std::nullopt;
  return std::move(named.front());
}

/// Returns the longest time that pushes last without a pause of kLeastStay_s between them, s.
double longest_together_s(const std::vector<ExplainedFault>& pushes) {
  std::vector<FaultSpan> spans;
  for (const ExplainedFault& push : pushes) spans.push_back({push.claim.onset_s, push.claim.end_s});
  std::ranges::sort(spans, {}, &FaultSpan::onset_s);
  double out = 0.0;
  FaultSpan together{0.0, -kNeverEnds};
  for (const FaultSpan& span : spans) {
    if (span.onset_s > together.end_s + kLeastStay_s) together = span;
    together.end_s = std::max(together.end_s, span.end_s);
    out = std::max(out, together.end_s - together.onset_s);
  }
  return out;
}

}  // namespace

std::vector<ExplainedFault> several_pushes(const LogFit& fit, const EvidenceLimits& limits, std::size_t most,
                                           double needed) {
  std::vector<ExplainedFault> out;
  std::vector<FaultClaim> known = fit.known();
  double together = 0.0;
  while (out.size() < most) {
    std::optional<ExplainedFault> push =
        next_push(out.empty() ? fit : LogFit(fit.log(), fit.model(), known, fit.noise()), limits);
    if (!push) break;
    together += push->evidence;
    known.push_back(push->claim);
    out.push_back(std::move(*push));
    const auto further = static_cast<double>(most - out.size());  // a later push seldom explains more
    if (together + further * out.back().evidence < needed) return {};
  }
  // Pushes that follow each other without a pause are a longer force, which is another fault.
  const bool explains = !out.empty() && together > needed && !has_large_misfit(out.back()) &&
                        longest_together_s(out) <= kLongestBlow_s;
  return explains ? out : std::vector<ExplainedFault>{};
}

}  // namespace faultline
