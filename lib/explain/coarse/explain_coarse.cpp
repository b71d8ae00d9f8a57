// SPDX-License-Identifier: MIT
#include "lib/explain/coarse/explain_coarse.hpp"

#include <algorithm>
#include <cmath>

#include "lib/core/statistics.hpp"
#include "lib/explain/coarse/coarse_bench.hpp"
#include "lib/explain/coarse/coarse_search.hpp"
#include "lib/explain/coarse/fault_directions.hpp"
#include "lib/explain/fault_spans.hpp"

namespace faultline {
namespace {

using Eigen::VectorXd;

constexpr std::size_t kJudged = 14;            // candidates of the search that are rated, best first
constexpr std::size_t kApproached = 8;         // guesses that are moved towards their best onset
constexpr std::size_t kOnsetsForAllKinds = 2;  // onsets at which every linear kind is tried
constexpr std::size_t kMoved = 4;              // hypotheses whose onset is refined
constexpr int kMostMoves = 24;                 // rounds of moves of an onset, at most
constexpr int kNewton = 6;                     // steps of onset and size together
// Moves of an onset: s of the first, at least; s and share of a sample down to which they are halved.
constexpr double kLeastFirstMove_s = 0.04, kLeastMove_s = 0.001, kLeastMove = 0.03;
constexpr double kFirstLeap_s = 1.2, kLastLeap_s = 0.3;  // s: first leap of an onset, halved down to the last
constexpr int kMostLeaps = 12;                           // at most, for the time of computation
constexpr double kStandsFor_s = 0.3;     // s at the end of a log that give the position of a locked joint
constexpr double kStillWithin = 5.0;     // standard deviations of a measurement: a joint at rest is nearer
constexpr double kStillRounding = 1e-6;  // rad, m, rad/s or m/s: rounding of measurements without noise
constexpr int kFewestRepeated = 4;       // samples that repeat a code to the end, at least

/// Returns whether a fault of the kind changes numbers of the law of motion, and lasts.
bool is_linear_at_coarse(FaultKind kind) {
  return kind == FaultKind::torque_loss || kind == FaultKind::friction_increase ||
         kind == FaultKind::payload_change || kind == FaultKind::torque_sensor_error;
}

/// Returns the best candidates of the search, and every linear kind at the onsets that stand out most. Judges
/// unknown faults there.
std::vector<CoarseGuess> guesses_of(const CoarseSearch& search, CoarseBench& bench) {
  const CoarseLog& log = bench.log;
  const int n = log.joints();
  std::vector<CoarseGuess> out;
  for (std::size_t k = 0; k < std::min(kJudged, search.candidates.size()); ++k)
    out.push_back(search.candidates[k].guess);
  for (std::size_t k = 0; k < std::min(kOnsetsForAllKinds, search.onsets.size()); ++k) {
    const double onset = log.time_s(search.onsets[k]);
    for (const FaultLabel& label : fault_labels_of(*log.model))
      if (is_linear_at_coarse(label.kind)) out.push_back({label.kind, label.joint, onset});
    for (int j = 0; j < n; ++j) bench.go({FaultKind::unknown, Joint::at(j), onset}, 1);
  }
  return out;
}

/// Judges the guesses that explain the log best with tolerated errors, then again at their best onsets.
void judge_candidates(const CoarseSearch& search, CoarseBench& bench) {
  std::vector<JudgedGuess> rated;
  for (const CoarseGuess& guess : guesses_of(search, bench)) {
    auto e = judge_coarse(bench.log, guess, {.rounds = 1, .tolerated_share = kFirstTolerated});
    if (e) rated.push_back({guess, guess.kind, e->log_likelihood, std::move(*e)});
  }
  std::ranges::stable_sort(rated, std::ranges::greater{}, &JudgedGuess::gain);
  std::size_t approached = 0;
  for (const JudgedGuess& r : rated) {
    if (approached == kApproached) break;
    if (bench.tried_near(r.guess.kind, r.guess.joint, r.guess.onset_s)) continue;
    bench.go(r.guess, 1, r.fit.steps);
    bench.go_near(r.guess, r.fit.steps);
    ++approached;
  }
}

/// Judges a lock of joint `j` (from 0) since it stands still, if it does to the end of the log.
void judge_standstill(int j, CoarseBench& bench) {
  const CoarseLog& log = bench.log;
  const OneStepModel& m = *log.model;
  const int n = log.joints(), samples = log.samples();
  const auto q = log.read.row(j), v = log.read.row(n + j);
  const int tail = std::min(samples, std::max(3, static_cast<int>(kStandsFor_s / log.period_s())));
  const VectorXd end = q.tail(tail);
  const double rest = upper_median({end.data(), end.data() + end.size()});
  const double q_still = kStillWithin * std::sqrt(m.reading_variance[j]) + kStillRounding;
  const double v_still = kStillWithin * std::sqrt(m.reading_variance[n + j]) + kStillRounding;
  int since = samples;
  while (since > 0 && std::abs(q[since - 1] - rest) <= q_still && std::abs(v[since - 1]) <= v_still) --since;
  if (samples - since <= 3) return;
  for (const int before : {2, 1, 0})
    for (const double share : {0.2, 0.5, 0.8}) {
      const double onset_s = log.time_s(std::max(1, since - before)) - share * log.period_s();
      bench.go({FaultKind::locked, Joint::at(j), onset_s}, 1);
    }
}

/// Judges a stuck encoder and a lock of joint `j` (from 0) since its codes repeat to the end of the log.
void judge_repeats(int j, CoarseBench& bench) {
  const CoarseLog& log = bench.log;
  const OneStepModel& m = *log.model;
  const int samples = log.samples();
  int same = samples;
  while (same > 1 && log.log.q(same - 1, j) == log.log.q(same - 2, j)) --same;
  if (samples - same < kFewestRepeated || samples - same <= 2 * m.longest_repeat[j]) return;
  for (const int first : {same, same - 1}) {  // first false code: repeats the last true one, or is a new one
    if (first < 1) continue;
    const double onset_s = log.time_s(first) - 0.5 * log.period_s();
    bench.go({FaultKind::stuck_encoder, Joint::at(j), onset_s});
    bench.go({FaultKind::locked, Joint::at(j), onset_s}, 1);
  }
}

/// Returns whether a hypothesis may have this onset.
bool may_begin(const CoarseLog& log, double onset_s) {
  return onset_s >= log.time_s(log.first_onset()) && onset_s < log.time_s(log.samples() - 3);
}

/// Moves onset and end of the best guess, about the same trajectory, if that explains more; returns whether.
bool try_times(double onset_step_s, double end_step_s, JudgedGuess& best, CoarseBench& bench) {
  const CoarseGuess guess = with_times_moved(best.guess, onset_step_s, end_step_s);
  if (!may_begin(bench.log, guess.onset_s)) return false;
  std::optional<JudgedGuess> now = bench.go(guess, 1, best.fit.steps);
  if (!now || now->gain <= best.gain) return false;
  best = std::move(*now);
  return true;
}

/// Moves the onset, and the end if there is one, by steps of a sample, then halved ones, while that explains
/// more.
JudgedGuess walked(JudgedGuess best, CoarseBench& bench) {
  const double period = bench.log.period_s();
  const bool ends = best.guess.duration_s > 0.0;
  double step = std::max(period, kLeastFirstMove_s);
  for (int moves = 0; moves < kMostMoves && step > std::max(kLeastMove * period, kLeastMove_s); ++moves) {
    bool any = try_times(-step, 0.0, best, bench) || try_times(step, 0.0, best, bench);
    if (ends) any = try_times(0.0, -step, best, bench) || try_times(0.0, step, best, bench) || any;
    if (!any) step *= 0.5;
  }
  return best;
}

/// Moves likewise and by leaps, since the search evaluated only a few seconds after an onset. Then integrates
/// anew.
JudgedGuess moved(const JudgedGuess& start, CoarseBench& bench) {
  JudgedGuess best = walked(start, bench);
  bool leapt = false;
  double leap = kFirstLeap_s;
  for (int leaps = 0; leaps < kMostLeaps && leap >= kLastLeap_s; ++leaps) {
    if (try_times(-leap, 0.0, best, bench) || try_times(leap, 0.0, best, bench))
      leapt = true;
    else
      leap *= 0.5;
  }
  if (leapt) best = walked(best, bench);
  const bool stayed =
      best.guess.onset_s == start.guess.onset_s && best.guess.duration_s == start.guess.duration_s;
  if (stayed || start.guess.kind == FaultKind::locked) return best;
  const std::optional<JudgedGuess> anew = bench.go(best.guess, CoarseBench::kCoarseRounds, best.fit.steps);
  return anew && anew->gain > best.gain ? *anew : best;
}

/// Moves onset and size together by Newton steps.
void settle(JudgedGuess at, CoarseBench& bench) {
  for (int k = 0; k < kNewton; ++k) {
    const std::optional<NewtonStep> step =
        newton_step(bench.log, at.guess, {.move_onset = true, .known = at.fit.steps});
    if (!step) break;
    std::optional<JudgedGuess> next = bench.go(step->guess, CoarseBench::kCoarseRounds - 1, at.fit.steps);
    if (!next || std::abs(step->onset_step_s) < kSettled_s) break;
    at = std::move(*next);
  }
}

void refine(const JudgedGuess& start, CoarseBench& bench) {
  JudgedGuess best = moved(start, bench);
  if (moves_with_onset(start.guess.kind)) settle(std::move(best), bench);
}

/// Returns the best few guesses, one of each kind and joint; a free joint is a lost torque.
std::vector<JudgedGuess> to_refine(const std::vector<JudgedGuess>& all) {
  std::vector<JudgedGuess> sorted = all, out;
  std::ranges::stable_sort(sorted, std::ranges::greater{}, &JudgedGuess::gain);
  for (JudgedGuess& j : sorted) {
    const bool known = std::ranges::any_of(out, [&](const JudgedGuess& o) {
      return o.guess.kind == j.guess.kind && o.guess.joint == j.guess.joint;
    });
    if (!known) out.push_back(std::move(j));
    if (out.size() == kMoved) break;
  }
  return out;
}

}  // namespace

LogExplanation explain_coarse(const CoarseLog& log) {
  CoarseBench bench(log);
  const RoughSearch rough = search_roughly(log);
  const bool is_quiet = !rough.stands_out;
  if (!is_quiet) judge_candidates(search_coarse(log), bench);
  for (int j = 0; j < log.joints(); ++j) {
    if (!is_quiet) judge_standstill(j, bench);
    judge_repeats(j, bench);
  }
  bench.integrate_best();
  for (const JudgedGuess& j : to_refine(bench.best)) {
    const FaultKind kind = j.guess.kind;
    const bool fixed = kind == FaultKind::stuck_encoder || kind == FaultKind::sensor_bias ||
                       kind == FaultKind::unknown;  // begins with a sample, or does not determine its onset
    const double enough = std::max(kWorthRefining, kMayWin * bench.best_gain());
    if (j.gain >= enough && !fixed) refine(j, bench);
  }
  LogExplanation out = bench.explanation();
  for (const FaultHypothesis& h : out.best) out.most_of_a_push = std::max(out.most_of_a_push, h.gain);
  if (rough.nearest) {
    CoarseBench nearest(log);
    nearest.go(rough.nearest->guess, 1);
    out.quiet = nearest.explanation().best;
  }
  return out;
}

FaultClaim followed_coarse(const CoarseLog& log, FaultClaim lasting, double limit) {
  CoarseBench bench(log);
  std::optional<JudgedGuess> best = bench.go(guess_of(lasting));
  double end_s = log.end_s();
  for (double step = 0.5 * (end_s - log.time_s(0)); best && step > 0.5 * log.period_s(); step *= 0.5)
    for (const double moved_s : {end_s - step, end_s + step}) {
      if (moved_s >= log.end_s()) continue;
      CoarseGuess guess = best->guess;
      guess.duration_s = moved_s - guess.onset_s;
      std::optional<JudgedGuess> ends = bench.go(guess, CoarseBench::kCoarseRounds, best->fit.steps);
      const double enough = best->guess.duration_s > 0.0 ? best->gain : best->gain + kEndEvidence;
      if (!ends || ends->gain <= enough) continue;
      best = std::move(ends);
      end_s = moved_s;
    }
  if (!best || best->gain <= limit) {
    lasting.end_s = log.time_s(0);
    return lasting;
  }
  if (best->guess.duration_s > 0.0) lasting.end_s = end_s;
  if (best->fit.size.size() == lasting.size.size()) lasting.size = best->fit.size;
  return lasting;
}

}  // namespace faultline
