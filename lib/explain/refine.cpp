// SPDX-License-Identifier: MIT
#include "lib/explain/refine.hpp"

#include <algorithm>
#include <cmath>

#include "lib/explain/fault_spans.hpp"
#include "lib/explain/judge/judge.hpp"
#include "lib/explain/search/white_search.hpp"

namespace faultline {
namespace {

constexpr double kSameFault_s = 0.3;   // s between two onsets of one kind and joint that are one fault
constexpr double kLeastGain = 0.1;     // nats by which a move explains more
constexpr int kMostRefineMoves = 40;   // of an onset or an end: a size that grows could move it for ever
constexpr double kFirstMove_s = 1.28;  // of an onset or an end; halved each time that nothing is gained
constexpr double kStillEnough = 0.5;   // share of the evidence without an end that is kept with it, at least

/// Returns whether the same fault is known from about this moment on, or as a drift that lasts: it does not
/// begin twice.
bool is_known(const LogFit& fit, const FaultClaim& claim) {
  return std::ranges::any_of(fit.known(), [&](const FaultClaim& known) {
    return column_kind(known.kind) == column_kind(claim.kind) && known.joint == claim.joint &&
           (std::abs(known.onset_s - claim.onset_s) < kSameFault_s ||
            (claim.kind == FaultKind::sensor_drift && claim.onset_s > known.onset_s &&
             claim.onset_s < known.end_s));
  });
}

/// Returns whether onset and end may be moved; those of a stuck or jumped encoder lie at samples.
bool can_move(FaultKind kind) { return kind != FaultKind::stuck_encoder && kind != FaultKind::sensor_bias; }

/// Moves onset or end (a member of the claim) while that explains more: a few steps, then halved ones.
FaultHypothesis moved(FaultHypothesis best, double FaultClaim::*when, JudgedHypotheses& bench) {
  const LogFit& fit = bench.fit;
  const double row_s = fit.model().setting.row_s();
  const double earliest = fit.time_s()[std::min(first_onset_row(fit, best.kind), fit.count() - 1)],
               latest = fit.time_s()[std::max(0, fit.count() - 3)];
  const bool passes = best.kind == FaultKind::collision;
  const double shortest = passes ? row_s : kLeastStay_s, longest = passes ? kLongestBlow_s : kNeverEnds;
  const auto try_at = [&](double t) {
    FaultClaim claim = best;
    claim.*when = t;
    const double lasts_s = claim.end_s - claim.onset_s;
    if (t < earliest || t >= latest || lasts_s < shortest || lasts_s > longest) return false;
    std::optional<FaultHypothesis> h = bench.go(claim);
    if (!h || h->gain <= best.gain + kLeastGain) return false;
    best = std::move(*h);
    return true;
  };
  const double at = best.*when;
  for (const double d : {-.04, -.03, -.02, -.01, -.005, .005, .01, .02, .03, .04}) try_at(at + d);
  int moves = 0;
  for (double step = kFirstMove_s; step > 0.3 * row_s && moves < kMostRefineMoves; ++moves)
    if (!try_at(best.*when - step) && !try_at(best.*when + step)) step /= 2.0;
  const bool is_over = passes || best.end_s < earliest;  // before an onset could be seen: a push, if anything
  if (when != &FaultClaim::onset_s || is_over || best.onset_s > earliest + kSameFault_s) return best;
  FaultClaim claim = best;  // a fault that began in the lead, or before the log, has no onset in it
  claim.onset_s = fit.log().time_s(0);
  const std::optional<FaultHypothesis> from_start = bench.go(claim);
  return from_start && from_start->gain > best.gain + kLeastGain ? *from_start : best;
}

/// Returns residuals with the fault and without it, with the effects of the day estimated from the rows
/// before its onset: if a fault ends and the hypothesis does not, its own effects are biased.
WithAndWithout by_earlier_effects(const LogFit& fit, const FaultHypothesis& h) {
  const Stacked shift = fit.white_effects().times(h.fit.day - fit.day_before(h.onset_s));
  return {h.fit.left + shift, fit.residual_without_fault(h.fit) + shift};
}

/// Adds the hypothesis with an end, if the log shows that the fault is gone; it replaces those that last
/// longer.
void add_end(const FaultHypothesis& h, JudgedHypotheses& bench) {
  if (silences(h.kind) || h.end_s < kNeverEnds) return;
  const std::optional<double> end_s =
      absent_from_s(bench.fit, by_earlier_effects(bench.fit, h), h.onset_s + kLeastFault_s);
  if (!end_s) return;
  FaultClaim claim = h;
  claim.end_s = *end_s;
  const std::optional<FaultHypothesis> ends = bench.go(claim);
  if (!ends) return;
  const FaultHypothesis best = can_move(h.kind) ? moved(*ends, &FaultClaim::end_s, bench) : *ends;
  if (best.gain < kStillEnough * h.gain) return;
  std::erase_if(bench.judged, [&](const FaultHypothesis& other) {
    return column_kind(other.kind) == column_kind(best.kind) && other.joint == best.joint &&
           other.onset_s < best.end_s && other.end_s > best.end_s + kSameOnset_s;
  });
}

/// Adds a push of any form, with an onset and an end of its own, if it explains more than a plain one by the
/// share that any fault may miss its form. Apart from the plain one, since at wrong times a force of any form
/// explains as much as the plain one at the right times.
void add_any_form(const FaultHypothesis& plain, JudgedHypotheses& bench) {
  if (plain.kind != FaultKind::collision || plain.has_any_form) return;
  JudgedHypotheses apart{bench.fit};
  FaultClaim claim = plain;
  claim.has_any_form = true;
  const std::optional<FaultHypothesis> first = apart.go(claim);
  if (!first) return;
  FaultHypothesis best = moved(moved(*first, &FaultClaim::onset_s, apart), &FaultClaim::end_s, apart);
  if (best.gain > (1.0 + kFormShare) * std::max(0.0, plain.gain)) bench.judged.push_back(std::move(best));
}

}  // namespace

std::optional<FaultHypothesis> JudgedHypotheses::go(const FaultClaim& claim) {
  for (const double later_s : {0.0, kLeastFault_s})
    if (fit.is_silent(claim.joint, claim.onset_s + later_s)) return std::nullopt;
  if (is_known(fit, claim)) return std::nullopt;
  std::optional<FaultHypothesis> h = judge(fit, claim, best_gain());
  if (h) judged.push_back(*h);
  return h;
}

double JudgedHypotheses::best_gain() const {
  double best = 0.0;
  for (const FaultHypothesis& h : judged) best = std::max(best, h.gain);
  return best;
}

std::vector<FaultHypothesis> best_of_each(const std::vector<FaultHypothesis>& all) {
  std::vector<FaultHypothesis> out;
  for (const FaultHypothesis& h : all) {
    const auto known = std::ranges::find(out, h.label(), &FaultHypothesis::label);
    if (known == out.end())
      out.push_back(h);
    else if (h.gain > known->gain)
      *known = h;
  }
  std::ranges::stable_sort(out, std::ranges::greater{}, &FaultHypothesis::gain);
  return out;
}

void refine(const FaultHypothesis& h, JudgedHypotheses& bench) {
  FaultHypothesis best = can_move(h.kind) ? moved(h, &FaultClaim::onset_s, bench) : h;
  if (best.end_s < kNeverEnds && can_move(h.kind))
    add_any_form(moved(best, &FaultClaim::end_s, bench), bench);
  else
    add_end(best, bench);
}

}  // namespace faultline
