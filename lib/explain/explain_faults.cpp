// SPDX-License-Identifier: MIT
#include "lib/explain/explain_faults.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "lib/explain/day/day_ripples.hpp"
#include "lib/explain/fault_spans.hpp"
#include "lib/explain/further_faults.hpp"
#include "lib/explain/judge/judge.hpp"
#include "lib/explain/refine.hpp"
#include "lib/explain/search/sensor_jumps.hpp"
#include "lib/explain/several_pushes.hpp"

namespace faultline {
namespace {

constexpr std::size_t kMostFaults = 12;   // faults of one log, at most
constexpr std::size_t kMostTogether = 3;  // faults that are tried together if one alone does not suffice
constexpr std::size_t kFirsts = 3;        // named faults, at most, beside which further ones are searched
constexpr int kStretchRounds = 2;         // in which the stretches of other signals are judged
constexpr double kFirstShare = 0.3;       // share of the best evidence that each of these has, at least
constexpr double kAlike = 0.4;            // least ratio of the sizes of two jumps of a belt that slips
constexpr double kPriceOfRipple = 20.0;   // nats: of its rate, sine and cosine

/// A log, the model that explains it and the limits for its faults.
struct GivenLog {
  const UniformLog& log;
  const BalanceModel& model;
  const EvidenceLimits& limits;
};

/// One step of the explanation: the faults that best explain the residuals of the known ones, best first.
struct NextFault {
  std::vector<ExplainedFault> named;  ///< none if the rest of the log is healthy
  /// By named fault: the spans in which the log shows it, if it is linear.
  std::vector<std::vector<FaultClaim>> spans{};
  std::vector<ExplainedFault> pushes{};  ///< that explain the log better than the best of them; or none
  ExplainedFault unknown{};              ///< the best of them as a fault of no kind
  ExplainedLog rest{};                   ///< explanation of the log beside the known faults
  EvidenceScore score{};                 ///< of the log beside the known faults
};

/// Returns the effects of the day for reports, if the model uses them: friction, gain and offset by joint,
/// and ripples.
std::vector<DayEffect> effects_of(const LogFit& fit) {
  const DayLayout at = day_layout(fit.model());
  std::vector<DayEffect> out;
  const auto add = [&](DayEffectKind kind, int j, int index, double sign) {
    if (fit.model().day_variance[index] > kNoEffect)
      out.push_back({kind, Joint::at(j), sign * fit.healthy().day[index], fit.healthy().day_std[index],
                     std::sqrt(fit.model().day_variance[index])});
  };
  for (int j = 0; j < fit.joints(); ++j) add(DayEffectKind::friction, j, at.friction(j), 1.0);
  for (int j = 0; j < fit.joints(); ++j) add(DayEffectKind::torque_gain, j, at.gain(j), -1.0);
  for (int j = 0; j < fit.joints(); ++j) add(DayEffectKind::torque_offset, j, at.offset(j), -1.0);
  for (int j = 0; j < fit.joints(); ++j)
    if (const std::optional<DayEffect> ripple = ripple_of_day(fit, j)) out.push_back(*ripple);
  return out;
}

/// Returns the duration of the rows whose kernel crosses no lost sample.
double judged_s(const LogFit& fit) {
  const std::vector<bool>& lost = fit.rows().lost;
  return fit.model().setting.row_s() * static_cast<double>(std::count(lost.begin(), lost.end(), false));
}

/// Returns the pushes that explain a log together if they do so better than its best fault, which lasts, and
/// than the free form. A fault that lasts may explain more than the first push, but less than all of them;
/// the many disturbances of a fault of no known kind have another form than pushes. `e` is the explanation
/// of the log, `best` its best named fault.
std::vector<ExplainedFault> pushes_instead(const LogFit& fit, const LogExplanation& e,
                                           const ExplainedFault& best, const EvidenceLimits& limits) {
  const auto push = std::ranges::find(e.best, FaultKind::collision, &FaultHypothesis::kind);
  const double needed = std::max(best.evidence, e.free_gain);
  if (best.claim.end_s - best.claim.onset_s < kLongestBlow_s || push == e.best.end() ||
      push->gain * kMostFaults < needed)
    return {};
  return several_pushes(fit, limits, kMostFaults, needed);
}

/// Whether several pushes are compared with the best fault: beside a first fault of several, they are not.
enum class Pushes { compared, left_out };

NextFault next_fault(const GivenLog& given, const std::vector<FaultClaim>& known, Pushes pushes) {
  const EvidenceLimits& limits = given.limits;
  // The halt of a known lock raises the noise of the other joints and makes the search less exact.
  const bool is_exact = std::ranges::none_of(known, &silences, &FaultClaim::kind);
  const double least = is_exact ? least_limit(limits) : 0.0;
  const ExplainedFit explained = explain_with_own_noise(
      given.log, given.model, known, [least](const LogFit& beside) { return explain_log(beside, least); });
  const LogFit& fit = explained.fit;
  const LogExplanation& e = explained.explanation;
  NextFault out{.named = further_faults(fit, e, limits, kFirsts), .score = score_of(e, limits)};
  if (pushes == Pushes::compared && !out.named.empty())
    out.pushes = pushes_instead(fit, e, out.named.front(), limits);
  for (const ExplainedFault& fault : out.named)
    out.spans.push_back(fault_spans(fit, fault.claim, e.free_form));
  if (out.named.empty() && known.empty())
    if (const std::optional<ExplainedFault> unnamed = unnamed_fault(e, limits)) {
      out.named = {*unnamed};
      out.spans = {{}};
      out.unknown = *unnamed;
      return out;
    }
  if (!out.named.empty())
    out.unknown = as_unknown(out.named.front(), e);
  else
    out.rest = {.day = effects_of(fit), .loudness = noise_levels(fit), .judged_s = judged_s(fit)};
  return out;
}

/// Returns `before`, and the claims of all faults except that at `left_out`.
std::vector<FaultClaim> claims_but(const std::vector<ExplainedFault>& faults, std::size_t left_out,
                                   std::vector<FaultClaim> before) {
  std::vector<FaultClaim> out = std::move(before);
  for (std::size_t k = 0; k < faults.size(); ++k)
    if (k != left_out) out.push_back(faults[k].claim);
  return out;
}

/// Onset and end of faults that are judged again.
enum class Times { as_claimed, refined };

/// Whether `again` may replace a fault that was named before: it suffices, and does not replace a fault of a
/// known kind that suffices by one of no known kind.
bool may_replace(const ExplainedFault& again, const ExplainedFault& before) {
  const bool is_known = before.claim.kind != FaultKind::unknown && !has_large_misfit(before);
  return !has_large_misfit(again) && !(is_known && again.claim.kind == FaultKind::unknown);
}

/// Judges each fault again with all others known, in order, and drops it if they explain the log without it.
std::vector<ExplainedFault> judged_beside(const GivenLog& given, const std::vector<FaultClaim>& before,
                                          const RowNoise& noise, Times times,
                                          std::vector<ExplainedFault> faults) {
  for (std::size_t k = 0; k < faults.size();) {
    const LogFit fit(given.log, given.model, claims_but(faults, k, before), noise);
    LogExplanation e = explain_log(fit);
    JudgedHypotheses own{fit};
    const std::optional<FaultHypothesis> first = own.go(faults[k].claim);
    if (first && times == Times::refined) refine(*first, own);
    const double gain = first ? first->gain : 0.0;
    e.best.insert(e.best.end(), own.judged.begin(), own.judged.end());
    e.best = best_of_each(e.best);
    const std::vector<ExplainedFault> again = named_faults(with_evidence(fit, std::move(e)), given.limits, 1);
    if (!again.empty() && may_replace(again[0], faults[k])) {
      faults[k] = again[0];
    } else if (gain <= given.limits.of(faults[k].claim.kind)) {
      faults.erase(faults.begin() + static_cast<std::ptrdiff_t>(k));
      k = 0;  // faults that were judged beside it are judged without it
      continue;
    }
    ++k;
  }
  return faults;
}

/// Judges each fault again with all others known, the weakest first, and drops it if they explain the log
/// without it. A fault that leaves much beside another one's first onset and end is judged once more beside
/// their estimates. `before` are known and stay.
std::vector<ExplainedFault> jointly(const GivenLog& given, const std::vector<FaultClaim>& before,
                                    std::vector<ExplainedFault> faults) {
  std::ranges::stable_sort(faults, {}, &ExplainedFault::evidence);
  const RowNoise noise = LogFit(given.log, given.model, claims_but(faults, faults.size(), before)).noise();
  faults = judged_beside(given, before, noise, Times::as_claimed, std::move(faults));
  if (std::ranges::none_of(faults, &has_large_misfit)) return faults;
  return judged_beside(given, before, noise, Times::refined, std::move(faults));
}

/// Returns the first of the `most` best named faults that comes and goes and explains the log by this: as a
/// fault in each of its spans, judged beside each other. Empty if none does.
std::vector<ExplainedFault> repeated_fault(const GivenLog& given, const std::vector<FaultClaim>& known,
                                           const NextFault& next, std::size_t most) {
  for (std::size_t k = 0; k < most; ++k) {
    if (next.spans[k].size() < 2 || next.spans[k].size() > kMostFaults) continue;
    std::vector<ExplainedFault> out;
    for (const FaultClaim& span : next.spans[k]) {
      out.push_back(next.named[k]);
      out.back().claim = span;
      out.back().misfit = std::numeric_limits<double>::infinity();  // until it is judged
    }
    out = jointly(given, known, std::move(out));
    if (out.size() > 1 && std::ranges::none_of(out, &has_large_misfit)) return out;
  }
  return {};
}

/// Returns the fault that best explains the residuals; or several that explain them together, if one alone
/// leaves much; or a fault of no known kind, if these leave much, too.
std::vector<ExplainedFault> best_faults(const GivenLog& given, const std::vector<FaultClaim>& known,
                                        const NextFault& next) {
  if (!next.pushes.empty()) return next.pushes;
  const ExplainedFault& alone = next.named.front();
  // A drive that clips is no known kind: several known faults that explain the log are preferred to it.
  const bool is_enough = suffices(alone) && alone.claim.kind != FaultKind::unknown;
  std::vector<ExplainedFault> repeated =
      repeated_fault(given, known, next, is_enough ? 1 : next.named.size());
  if (!repeated.empty()) return repeated;
  if (is_enough) return {alone};
  for (const ExplainedFault& first : next.named) {
    if (first.claim.kind == FaultKind::unknown || first.evidence < kFirstShare * alone.evidence) continue;
    std::vector<FaultClaim> more = known;
    std::vector<ExplainedFault> together = {first};
    double shrinking = 0.0;  // of all but the last: no further fault takes it away
    while (together.size() < kMostTogether) {
      more.push_back(together.back().claim);
      shrinking += together.back().shrinking;
      const NextFault another = next_fault(given, more, Pushes::left_out);
      if (another.named.empty()) break;
      // Beside a part of a fault that comes and goes the other parts are easier to find.
      repeated = repeated_fault(given, known, another, another.named.size());
      if (!repeated.empty()) return repeated;
      together.push_back(another.named.front());
      together.back().misfit += shrinking;
      if (together.back().claim.kind == FaultKind::unknown) break;
      if (!has_large_misfit(together.back())) return together;
    }
  }
  return {suffices(alone) ? alone : next.unknown};
}

/// Replaces a false reading within another one of the joint that is its opposite by two that follow each
/// other: both predict the same log, and the robot is healthy in between.
std::vector<ExplainedFault> unnested(std::vector<ExplainedFault> faults) {
  for (ExplainedFault& outer : faults)
    for (ExplainedFault& inner : faults) {
      FaultClaim &a = outer.claim, &b = inner.claim;
      if (a.kind != FaultKind::sensor_bias || b.kind != a.kind || a.joint != b.joint) continue;
      if (a.onset_s >= b.onset_s || a.end_s <= b.end_s) continue;
      if (!takes_back(b.size[0], a.size[0])) continue;
      const double end_s = a.end_s;
      a.end_s = b.onset_s;
      b = {a.kind, a.joint, b.end_s, end_s, a.size};
      inner.alarm_s = std::max(inner.alarm_s, b.onset_s);
    }
  return faults;
}

bool is_slip(const FaultClaim& a, const FaultClaim& b) {
  return a.kind == FaultKind::sensor_bias && b.kind == a.kind && a.joint == b.joint && a.end_s == b.end_s &&
         a.onset_s < b.onset_s && b.size[0] / a.size[0] > kAlike && a.size[0] / b.size[0] > kAlike;
}

/// Replaces jumps of an encoder in one direction, such as by a belt that slips, by one fault of no known
/// kind. `faults` are sorted by onset.
std::vector<ExplainedFault> without_slips(std::vector<ExplainedFault> faults) {
  for (std::size_t k = 0; k < faults.size(); ++k) {
    const FaultClaim first = faults[k].claim;
    if (std::erase_if(faults, [&](const ExplainedFault& other) { return is_slip(first, other.claim); }) == 0)
      continue;
    faults[k].could_also_be.insert(faults[k].could_also_be.begin(), faults[k].label());
    faults[k].claim.kind = FaultKind::unknown;
    faults[k].claim.size = {};
  }
  return faults;
}

/// Explains the log beside the known faults `before`.
ExplainedLog explained_beside(const GivenLog& given, const std::vector<FaultClaim>& before) {
  ExplainedLog out;
  std::vector<ExplainedFault> faults;
  EvidenceScore score;  // what a known fault leaves is no alarm: the score is that of a log without one
  while (faults.size() < kMostFaults) {
    const std::vector<FaultClaim> known = claims_but(faults, faults.size(), before);
    NextFault next = next_fault(given, known, Pushes::compared);
    out = std::move(next.rest);
    if (known.empty()) score = next.score;
    if (next.named.empty()) break;
    for (ExplainedFault& fault : best_faults(given, known, next)) faults.push_back(std::move(fault));
  }
  if (faults.size() > 1) faults = jointly(given, before, std::move(faults));
  faults = unnested(std::move(faults));
  std::ranges::stable_sort(faults, {}, [](const ExplainedFault& fault) { return fault.claim.onset_s; });
  out.faults = without_worn_spots(given.log, given.model, before, without_slips(std::move(faults)));
  for (const ExplainedFault& fault : out.faults) score = larger(score, score_of(fault));
  out.score = score;
  return out;
}

std::vector<FaultClaim> joined(std::vector<FaultClaim> claims, const std::vector<FaultClaim>& more) {
  claims.insert(claims.end(), more.begin(), more.end());
  return claims;
}

/// Returns the claims of faults that no stretch of a drive may have caused: those of other joints, and those
/// that begin beside all stretches.
std::vector<FaultClaim> apart_from(const std::vector<SignalStretch>& stretches,
                                   const std::vector<ExplainedFault>& faults) {
  std::vector<FaultClaim> out;
  for (const ExplainedFault& fault : faults)
    if (std::ranges::none_of(stretches, [&](const SignalStretch& stretch) {
          return stretch.pair == SignalPair::drive && stretch.joint == fault.claim.joint &&
                 fault.claim.onset_s > stretch.onset_s - kAsOne_s &&
                 fault.claim.onset_s < stretch.end_s + kAsOne_s;
        }))
      out.push_back(fault.claim);
  return out;
}

/// Explains a log with stretches of other signals. `alone` is what the torque balance shows without them. The
/// stretches are judged twice: beside the faults of `alone`, then beside those that are found beside them.
ExplainedLog explained_with_signals(const GivenLog& given, const std::vector<FaultClaim>& known,
                                    const SignalStretches& signals, const ExplainedLog& alone) {
  ExplainedLog out = alone;
  for (int round = 0; round < kStretchRounds; ++round) {
    const LogFit fit(given.log, given.model, joined(known, apart_from(signals.begin, out.faults)));
    std::vector<JudgedStretch> stretches = judged_stretches(signals.begin, alone.faults, known, &fit);
    const std::vector<FaultClaim> shown = balance_claims(stretches);
    out = shown.empty() ? alone : explained_beside(given, joined(known, shown));
    out.score = larger(out.score, alone.score);
    out.stretches = std::move(stretches);
    if (shown.empty() || out.faults.empty()) return out;
  }
  return out;
}

/// Returns the nats that robot, day and faults of known kinds leave of the log: half of each squared
/// residual, whitened by the noise of the healthy logs; rows without weight count as noise.
double left_beside(const UniformLog& log, const BalanceModel& model, const std::vector<FaultClaim>& known,
                   const ExplainedLog& explained) {
  std::vector<FaultClaim> claims = joined(known, balance_claims(explained.stretches));
  for (const ExplainedFault& fault : explained.faults)
    if (fault.claim.kind != FaultKind::unknown) claims.push_back(fault.claim);
  const LogFit fit(log, model, std::move(claims), model.noise);
  double out = 0.0;
  for (const double z : fit.healthy().left) out += std::isnan(z) ? 0.5 : 0.5 * z * z;
  return out;
}

}  // namespace

ExplainedLog explain_faults(const UniformLog& log, const BalanceModel& model, const EvidenceLimits& limits,
                            const std::vector<FaultClaim>& lasting, const SignalStretches& signals) {
  const std::vector<FaultClaim> before = followed(log, model, lasting), known = joined(before, signals.known);
  const auto explained = [&](const BalanceModel& day) {
    const GivenLog given{log, day, limits};
    ExplainedLog out = explained_beside(given, known);
    if (!signals.begin.empty()) out = explained_with_signals(given, known, signals, out);
    return out;
  };
  ExplainedLog out = explained(model);
  const bool is_quiet = std::ranges::none_of(out.loudness, [](double level) { return level >= kLoud; });
  if (!is_quiet || !out.faults.empty())
    if (const auto rippled = with_ripples_of_day(log, model, known)) {
      ExplainedLog other = explained(*rippled);
      const double price = kPriceOfRipple * rippled->ripples_of_day;
      if (left_beside(log, *rippled, known, other) + price < left_beside(log, model, known, out))
        out = std::move(other);
    }
  out.followed = before;
  return out;
}

}  // namespace faultline
