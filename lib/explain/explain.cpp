// SPDX-License-Identifier: MIT
#include "lib/explain/explain.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "lib/core/elementary/elementary.hpp"
#include "lib/explain/hypothesis.hpp"
#include "lib/explain/judge/judge.hpp"
#include "lib/explain/refine.hpp"
#include "lib/explain/search/search.hpp"
#include "lib/explain/search/sensor_jumps.hpp"
#include "lib/explain/search/standstill.hpp"

namespace faultline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Numbers of onsets that stand out: of all kinds together, as many of which are tried for each kind; for a
// drift.
constexpr std::size_t kOnsets = 6, kOnsetsOfDrifts = 4;
constexpr double kMuchLess = 0.5;  // share of a torque loss's excess over noise: a clipping drive leaves less
constexpr double kMayPass =
    0.33;  // share of the least limit from which a log is judged: the search is not exact
constexpr std::size_t kJudgedFirst = 4;    // best candidates, judged before a log counts as quiet,
constexpr std::size_t kJudgedOfQuiet = 2;  // best candidates of a quiet log, judged for its score
constexpr double kHidden = 2.0;            // for these, times the least limit: quiet windows exceed it once
constexpr std::size_t kRefined = 5;        // best hypotheses that are refined, at most
constexpr double kSameNoise = 0.1;         // of a variance: noises that differ by less are the same
constexpr std::size_t kBeside = 5;         // best hypotheses beside which the noise is estimated anew
constexpr int kRoundsOfNoise = 3;          // of the noise beside the best explanation

/// Returns the `most` best candidates of a kind and joint, best first.
std::vector<Candidate> of(const std::vector<Candidate>& all, FaultKind kind, Joint joint,
                          std::size_t most = std::numeric_limits<std::size_t>::max()) {
  std::vector<Candidate> out;
  for (const Candidate& c : all)
    if (c.kind == kind && c.joint == joint) out.push_back(c);
  std::ranges::stable_sort(out, std::ranges::greater{}, &Candidate::score);
  if (out.size() > most) out.resize(most);
  return out;
}

/// Returns the onsets that stand out for any kind.
std::vector<double> common_onsets(const std::vector<Candidate>& all) {
  std::vector<Candidate> sorted;
  for (const Candidate& c : all)
    if (c.kind != FaultKind::sensor_drift || c.score > 5.0) sorted.push_back(c);
  std::ranges::stable_sort(sorted, std::ranges::greater{}, &Candidate::score);
  std::vector<double> out;
  for (const Candidate& c : sorted) {
    bool apart = true;
    for (const double t : out) apart = apart && std::abs(c.onset_s - t) > kSameOnset_s;
    if (apart) out.push_back(c.onset_s);
    if (out.size() == kOnsets) break;
  }
  return out;
}

std::set<double> onsets_of(const std::vector<Candidate>& own, const std::vector<double>& common,
                           std::size_t most) {
  std::set<double> out;
  for (const Candidate& c : own) out.insert(c.onset_s);
  for (std::size_t k = 0; k < std::min(most, common.size()); ++k) out.insert(common[k]);
  return out;
}

/// Returns the onsets at which every kind is tried: those that stand out, and that of the free form.
std::vector<double> onsets_to_try(const std::vector<Candidate>& all, const FreeForm& change, double row_s) {
  std::vector<double> out = common_onsets(all);
  for (const double rows : {-1.0, -0.5, 0.0}) out.insert(out.begin(), change.onset_s + rows * row_s);
  return out;
}

void judge_linear_kinds(const std::vector<Candidate>& all, const std::vector<double>& common,
                        JudgedHypotheses& bench) {
  const LogFit& fit = bench.fit;
  std::vector<double> changes;  // of the work piece
  for (const int k : changes_of(fit.healthy().path)) changes.push_back(fit.time_s()[k + 1]);
  for (const LinearFault& fault : fit.linear()) {
    const std::vector<Candidate> own = of(all, fault.kind, fault.joint);
    std::set<double> onsets = onsets_of(own, common, kOnsets);
    if (fault.joint == fit.last_joint()) onsets.insert(changes.begin(), changes.end());
    for (const double t : onsets)
      bench.go({.kind = fault.kind, .joint = fault.joint, .onset_s = t, .grows = fault.columns.grow});
    if (fault.columns.grow) continue;
    for (const Candidate& c : own)
      if (c.end_s < kNeverEnds) bench.go(c);
  }
}

void judge_candidates(const std::vector<Candidate>& all, const FreeForm& change, JudgedHypotheses& bench) {
  const LogFit& fit = bench.fit;
  const std::vector<double> common = onsets_to_try(all, change, fit.model().setting.row_s());
  judge_linear_kinds(all, common, bench);
  const std::vector<Candidate> blows = of(all, FaultKind::collision, fit.last_joint(), 4);
  for (const double t : onsets_of(blows, common, 5)) bench.go({FaultKind::collision, fit.last_joint(), t});
  for (int j = 0; j < fit.joints(); ++j) {
    const Joint joint = Joint::at(j);
    const std::vector<Candidate> drifts = of(all, FaultKind::sensor_drift, joint, 3);
    for (const Candidate& c : drifts) bench.go(c);
    // Sticking friction gives the likelihood many maxima over the size: it starts from that of the search.
    FaultClaim drift = drifts.empty() ? FaultClaim{FaultKind::sensor_drift, joint} : FaultClaim(drifts[0]);
    for (std::size_t k = 0; k < std::min(kOnsetsOfDrifts, common.size()); ++k) {
      drift.onset_s = common[k];
      bench.go(drift);
    }
    for (const Candidate& c : of(all, FaultKind::sensor_bias, joint)) bench.go(c);
    const std::vector<Candidate> locks = of(all, FaultKind::locked, joint);
    for (const double t : onsets_of(locks, common, kOnsets))
      bench.go({FaultKind::locked, joint, t,
                moves_from(fit, j, t + reach_s(fit.model().setting)).value_or(kNeverEnds)});
    for (const Candidate& c : locks)
      if (c.end_s < kNeverEnds) bench.go(c);
    for (const Candidate& c : of(all, FaultKind::stuck_encoder, joint)) bench.go(c);
  }
}

/// Returns the nats by which a free form explains the log better than the healthy robot.
double gain_of(const LogFit& fit, const FreeForm& change) {
  double left = 0.0;
  for (const double z : fit.healthy().left)
    if (!std::isnan(z)) left += 0.5 * z * z;
  return left - change.row_cost.sum();
}

/// Returns whether any hypothesis should be judged, by the onsets of the search and the free form. A position
/// that jumps has no score in the search. Scores assume white noise; a fault that lasts has more evidence if
/// the noise is weak at low frequencies, so that the best candidates are judged before a log counts as quiet.
bool stands_out(double free_gain, std::vector<Candidate> found, double least_evidence, const LogFit& fit) {
  const double least = std::max(kStandsOut, kMayPass * least_evidence);
  if (free_gain > least) return true;
  std::ranges::stable_sort(found, std::ranges::greater{}, &Candidate::score);
  if (std::ranges::any_of(
          found, [&](const Candidate& c) { return c.score > least || c.kind == FaultKind::sensor_bias; }))
    return true;
  if (found.size() > kJudgedFirst) found.resize(kJudgedFirst);
  const double most = most_hidden_by_white_noise(fit.noise());
  const double hidden = std::max(least, kHidden * least_evidence);
  std::erase_if(found, [&](const Candidate& c) { return most * c.score < hidden; });
  JudgedHypotheses bench{fit};
  return std::ranges::any_of(found, [&](const Candidate& c) {
    const std::optional<FaultHypothesis> h = bench.go(c);
    return h && h->gain > hidden;
  });
}

/// Judges the best candidates of a log in which none stands out.
std::vector<FaultHypothesis> judged_of_quiet(const LogFit& fit, std::vector<Candidate> found) {
  std::ranges::stable_sort(found, std::ranges::greater{}, &Candidate::score);
  if (found.size() > kJudgedOfQuiet) found.resize(kJudgedOfQuiet);
  JudgedHypotheses bench{fit};
  for (const Candidate& c : found) bench.go(c);
  return std::move(bench.judged);
}

/// Returns the evidence of a fault from its onset on, by the whitened residuals without it and with it,
/// beside the nats `at_onset` of other measurements. A row without weight counts as noise.
EvidenceCourse course_of(const LogFit& fit, double onset_s, double at_onset, const Stacked& without,
                         const Stacked& with) {
  const double edge = reach_s(fit.model().setting);
  EvidenceCourse out;
  double sum = at_onset;
  for (int k = 0; k < fit.count(); ++k) {
    if (fit.time_s()[k] < onset_s - edge) continue;
    for (int j = 0; j < fit.joints(); ++j) {
      const double a = without[j * fit.count() + k], b = with[j * fit.count() + k];
      sum += 0.5 * (a * a - (std::isnan(b) ? 1.0 : b * b));
    }
    out.time_s.push_back(std::max(fit.time_s()[k] + edge, onset_s));
    out.nats.push_back(sum);
  }
  return out;
}

/// Returns the largest evidence that a hypothesis has in the rows of a stretch of kLongestBlow_s, nats. A row
/// without weight counts as noise.
double most_of_a_push(const LogFit& fit, const FaultHypothesis& h) {
  const Stacked &without = fit.healthy().left, &with = h.fit.left;
  std::vector<double> until = {0.0};  // nats of the rows before each row
  double out = 0.0;
  for (int k = 0, begin = 0; k < fit.count(); ++k) {
    double nats = 0.0;
    for (int j = 0; j < fit.joints(); ++j) {
      const double a = without[j * fit.count() + k], b = with[j * fit.count() + k];
      if (!std::isnan(a)) nats += 0.5 * (a * a - (std::isnan(b) ? 1.0 : b * b));
    }
    until.push_back(until.back() + nats);
    while (fit.time_s()[k] - fit.time_s()[begin] > kLongestBlow_s) ++begin;
    out = std::max(out, until.back() - until[static_cast<std::size_t>(begin)]);
  }
  return out;
}

/// Returns the kinds that resemble a fault in the rows of its joint: they are judged at its onset and end. A
/// joint at rest is locked, or its encoder is stuck. A short disturbance of the torque is a push, a moment
/// without torque (a joint that falls to its end stop), or an offset of the torque. Torque that has no effect
/// for long is lost, or a lock withstands it.
std::vector<FaultKind> rivals_of(const FaultClaim& claim) {
  const FaultKind kind = column_kind(claim.kind);
  std::vector<FaultKind> alike = {FaultKind::locked, FaultKind::stuck_encoder};
  if (kind != FaultKind::locked && kind != FaultKind::stuck_encoder) {
    alike = {FaultKind::collision, FaultKind::torque_loss, FaultKind::torque_sensor_error};
    if (std::ranges::find(alike, kind) == alike.end()) return {};
    const bool is_brief = claim.end_s - claim.onset_s <= kLongestBlow_s;
    if (!is_brief) return {FaultKind::locked};
  }
  std::erase(alike, kind);
  return alike;
}

/// Returns whether the rows of some joint have much less noise, and those of none more.
bool is_quieter(const RowNoise& noise, const RowNoise& than) {
  bool out = false;
  for (std::size_t j = 0; j < noise.joint.size(); ++j) {
    const double ratio = autocovariance(noise.joint[j])[0] / autocovariance(than.joint[j])[0];
    if (ratio > 1.0 + kSameNoise) return false;
    out = out || ratio < 1.0 - kSameNoise;
  }
  return out;
}

/// Noise of a log beside a fault.
struct NoiseBeside {
  FaultLabel fault;
  RowNoise noise;
};

/// Returns the noise of the log as if one of its best explanations were known to be true: the first one that
/// lowers the noise, since the fault that raises it need not have the most evidence at first. An explanation
/// that excludes rows lowers the noise in any case and counts only if it is the best.
std::optional<NoiseBeside> quieter_noise(const LogFit& fit, const UniformLog& log,
                                         const std::vector<FaultHypothesis>& best) {
  if (!is_quieter(fit.model().noise, fit.noise())) return std::nullopt;
  for (std::size_t k = 0; k < std::min(kBeside, best.size()) && best[k].gain >= kStandsOut; ++k) {
    if (k > 0 && silences(best[k].kind)) continue;
    std::vector<FaultClaim> all = fit.known();
    all.push_back(best[k]);
    RowNoise beside = LogFit(log, fit.model(), std::move(all)).noise();
    if (is_quieter(beside, fit.noise())) return NoiseBeside{best[k].label(), std::move(beside)};
  }
  return std::nullopt;
}

}  // namespace

LogExplanation explain_log(const LogFit& fit, double least_evidence) {
  JudgedHypotheses bench{fit};
  LogExplanation out;
  out.free_form = free_form(fit);
  out.free_gain = gain_of(fit, out.free_form);
  out.healthy_square = fit.healthy().mean_square();
  const std::vector<Candidate> found = search(fit);
  if (!stands_out(out.free_gain, found, least_evidence, fit)) {
    out.quiet = judged_of_quiet(fit, found);
    return out;
  }
  judge_candidates(found, out.free_form, bench);
  std::vector<FaultHypothesis> top = best_of_each(bench.judged);
  if (top.size() > kRefined) top.resize(kRefined);
  for (const FaultHypothesis& h : top)
    if (h.gain >= std::max(kWorthRefining, kMayWin * bench.best_gain())) refine(h, bench);
  out.best = best_of_each(bench.judged);
  if (!out.best.empty()) {
    for (const FaultKind kind : rivals_of(out.best.front())) {
      FaultClaim rival = out.best.front();
      rival.kind = kind;
      if (const std::optional<FaultHypothesis> judged = bench.go(rival)) refine(*judged, bench);
    }
    out.best = best_of_each(bench.judged);
  }
  if (!out.best.empty() && column_kind(out.best.front().kind) == FaultKind::torque_loss) {
    FaultClaim claim = out.best.front();
    const double left = out.best.front().fit.mean_square();
    for (const double onset_s : {claim.onset_s, out.free_form.onset_s}) {
      claim.onset_s = onset_s;
      FaultHypothesis clipped = judge_clipped(fit, claim);
      if (clipped.fit.mean_square() - 1.0 < kMuchLess * (left - 1.0))
        bench.judged.push_back(std::move(clipped));
    }
    out.best = best_of_each(bench.judged);
  }
  for (const FaultHypothesis& h : out.best)
    out.most_of_a_push = std::max(out.most_of_a_push, std::min(h.gain, most_of_a_push(fit, h)));
  return with_evidence(fit, std::move(out));
}

ExplainedFit explain_with_own_noise(const UniformLog& log, const BalanceModel& model,
                                    const std::vector<FaultClaim>& known,
                                    const std::function<LogExplanation(const LogFit&)>& explain) {
  std::optional<NoiseBeside> beside;
  for (int round = 0;; ++round) {
    LogFit fit(log, model, known, beside ? std::optional(beside->noise) : std::nullopt);
    LogExplanation e = explain(fit);
    const bool is_settled =
        round == kRoundsOfNoise || e.best.empty() || (beside && beside->fault == e.best.front().label());
    std::optional<NoiseBeside> quieter;
    if (!is_settled) quieter = quieter_noise(fit, log, e.best);
    if (!quieter) return {std::move(fit), std::move(e)};
    beside = std::move(quieter);
  }
}

double misfit(const LogFit& fit, const FreeForm& change, const FaultHypothesis& h) {
  const MatrixXd left = unstacked(h.fit.left, fit.joints());
  const MatrixXd torque = unstacked(fit.residual_without_fault(h.fit), fit.joints()) - left;
  const VectorXd power =
                     torque.unaryExpr([](double f) { return std::isnan(f) ? 0.0 : f * f; }).rowwise().sum(),
                 edges = fault_edges(fit.rows(), fit.model().setting, h);
  const double edge_s = reach_s(fit.model().setting), from_s = std::min(h.onset_s, change.onset_s) - edge_s;
  const int end = fit.whitened_reach(fit.first_row(h.end_s + edge_s + fit.model().setting.row_s()));
  const auto lasts = [&](int k) { return fit.time_s()[k] > h.onset_s - edge_s && k < end; };
  double usual = 0.0, count = 0.0;
  for (int k = 0; k < fit.count(); ++k)
    if (lasts(k)) usual += power[k], count += 1.0;
  usual /= std::max(1.0, count);
  const double share = form_share(h.kind);
  double out = h.shrinking;
  for (int k = 0; k < fit.count(); ++k) {
    if (fit.time_s()[k] < from_s) continue;
    const double inexact = std::max(share * share * usual, kEdgeShare * kEdgeShare * edges[k] * power[k]);
    for (int j = 0; j < fit.joints(); ++j) {
      const double square = Eigen::numext::abs2(left(k, j));
      if (std::isnan(square)) continue;
      const double variance = lasts(k) ? std::clamp(square, 1.0, std::max(1.0, inexact)) : 1.0;
      out += 0.5 * (square / variance + elementary::log(variance));
    }
    out -= change.row_cost[k];
  }
  return out;
}

LogExplanation with_evidence(const LogFit& fit, LogExplanation e) {
  for (FaultHypothesis& h : e.best) {
    h.course = course_of(fit, h.onset_s, h.at_onset, fit.residual_without_fault(h.fit), h.fit.left);
    h.misfit = misfit(fit, e.free_form, h);
  }
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  const Stacked& left = e.free_form.left;
  e.free_course = course_of(fit, e.free_form.onset_s, 0.0, left, Stacked::Constant(left.size(), kNaN));
  return e;
}

}  // namespace faultline
