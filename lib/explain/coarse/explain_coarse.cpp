// SPDX-License-Identifier: MIT
#include "lib/explain/coarse/explain_coarse.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "lib/core/statistics.hpp"
#include "lib/explain/coarse/coarse_judge.hpp"
#include "lib/explain/coarse/coarse_price.hpp"
#include "lib/explain/coarse/coarse_search.hpp"

namespace faultline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kMuchLeft = 3.0;     // mean square from which an explanation may be none,
constexpr double kUnexplained = 0.3;  // and share of what the log leaves without it
constexpr double kFreeShare = 0.9;    // of the torque lost, from which a joint swings freely
constexpr std::size_t kJudged = 14;   // candidates
constexpr std::size_t kOnsetsForAllKinds = 2;
constexpr int kSameSamples = 3;       // between two onsets that count as one
constexpr int kRounds = 3;            // of a judgement
constexpr std::size_t kMoved = 4;     // hypotheses whose onset is refined
constexpr double kWorthMoving = 5.0;  // nats
constexpr int kMostMoves = 24;
constexpr int kNewton = 6;              // steps of onset and size together
constexpr double kLongSample_s = 0.05;  // from which an onset moves by shares of a sample
constexpr double kMove_s = 0.04, kLeastMove_s = 0.001, kLeastMove = 0.03;
/// Shares of each state that a wrong onset may miss: a sample's worth, then a fifth each time.
constexpr std::array<double, 4> kForgivenInTurn = {5e-3, 1e-3, 2e-4, 4e-5};
constexpr int kStepsForEach = 2;
constexpr double kMostNewton = 0.7, kMostNewton_s = 0.03, kSettled_s = 2e-4;
constexpr double kStandsFor_s = 0.3;  // at the end of a log: where a locked joint stands
constexpr double kStillWithin = 5.0;  // standard deviations of a reading
constexpr double kStillRounding = 1e-6;
constexpr int kFewestRepeated = 4;  // samples that repeat a code to the end

bool moves_with_onset(FaultKind kind) {
  return kind != FaultKind::sensor_bias && kind != FaultKind::sensor_drift &&
         kind != FaultKind::stuck_encoder && kind != FaultKind::unknown;
}

/// A step of Newton on onset and size together; false where the guess cannot be integrated. `step_s` receives
/// by how much the onset wanted to move.
bool newton_step(const CoarseLog& log, double forgiven, CoarseGuess& guess, double* step_s) {
  const double most = log.period_s() > kLongSample_s ? kMostNewton * log.period_s() : kMostNewton_s;
  const CoarseExplanation fit =
      judge_coarse(log, guess, {.rounds = 1, .move_onset = true, .forgiven = forgiven});
  if (fit.log_likelihood < -0.1 * kImpossibleAtCoarse) return false;
  guess.onset_s = std::clamp(guess.onset_s + std::clamp(fit.onset_step_s, -most, most),
                             log.time_s(log.first_onset()), log.time_s(log.samples() - 3));
  guess.start = fit.size;
  *step_s = fit.onset_step_s;
  return true;
}

/// The guess brought near its best onset and size. What a wrong onset leaves is first forgiven, then ever
/// less, so that the steps of Newton find their way from a sample away.
CoarseGuess approached(const CoarseLog& log, CoarseGuess guess) {
  for (const double forgiven : kForgivenInTurn)
    for (int k = 0; k < kStepsForEach; ++k) {
      double step = 0.0;
      if (!newton_step(log, forgiven, guess, &step)) return guess;
      if (std::abs(step) < kSettled_s) break;
    }
  return guess;
}

/// A hypothesis that was judged.
struct Judged {
  CoarseGuess guess;
  FaultKind kind = FaultKind::none;  ///< as it is called: a lost torque may be a free joint
  double gain = -1e300;
  CoarseExplanation fit;
};

/// Judges hypotheses of one log; keeps the best of each kind and joint, and the onsets of all.
struct CoarseBench {
  const CoarseLog& log;
  std::vector<Judged> best;
  std::vector<CoarseGuess> tried;

  /// Judges a guess as it is and, where its onset matters, from where its best onset is.
  void try_from(const CoarseGuess& guess) {
    if (guess.kind == FaultKind::torque_loss && log.model->torque_is_measured) return;
    go(guess, kRounds);
    if (moves_with_onset(guess.kind)) go(approached(log, guess), kRounds);
  }
  Judged go(const CoarseGuess& guess, int rounds) {
    Judged out{guess, guess.kind, 0.0, judge_coarse(log, guess, {.rounds = rounds})};
    out.gain = out.fit.log_likelihood - log.healthy.log_likelihood;
    if (guess.kind == FaultKind::torque_loss && out.fit.size[0] > kFreeShare)
      out.kind = FaultKind::free_swinging;
    tried.push_back(guess);
    const auto known = std::find_if(best.begin(), best.end(), [&](const Judged& o) {
      return o.kind == out.kind && o.guess.joint == out.guess.joint;
    });
    if (known == best.end())
      best.push_back(out);
    else if (out.gain > known->gain)
      *known = out;
    return out;
  }
  bool tried_near(FaultKind kind, int joint, double onset_s) const {
    return std::any_of(tried.begin(), tried.end(), [&](const CoarseGuess& g) {
      return g.kind == kind && g.joint == joint &&
             std::abs(g.onset_s - onset_s) < kSameSamples * log.period_s();
    });
  }
};

bool more(const Judged& a, const Judged& b) { return a.gain > b.gain; }

void judge_candidates(const CoarseSearch& search, CoarseBench& bench) {
  const CoarseLog& log = bench.log;
  const int n = log.joints();
  for (std::size_t k = 0; k < std::min(kJudged, search.candidates.size()); ++k)
    bench.try_from(search.candidates[k].guess);
  for (std::size_t k = 0; k < std::min(kOnsetsForAllKinds, search.onsets.size()); ++k) {
    const double onset = log.time_s(search.onsets[k]);
    const auto try_one = [&](FaultKind kind, int joint) {
      if (!bench.tried_near(kind, joint, onset)) bench.try_from({kind, joint, onset, 0.0, {}});
    };
    for (int j = 1; j <= n; ++j) try_one(FaultKind::torque_loss, j);
    for (int j = 1; j <= n; ++j) try_one(FaultKind::friction_increase, j);
    try_one(FaultKind::payload_change, n);
    for (int j = 1; j <= n; ++j) bench.go({FaultKind::unknown, j, onset, 0.0, {}}, 1);
  }
}

/// Since when joint `j` (from 0) stands still, and since when its codes are the same.
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
  const auto lock = [&](double onset) { bench.go({FaultKind::locked, j + 1, onset, 0.0, {}}, 1); };
  if (samples - since > 3)
    for (const int before : {2, 1, 0})
      for (const double share : {0.1, 0.3, 0.5, 0.7, 0.9})
        lock(log.time_s(std::max(1, since - before)) - share * log.period_s());
  int same = samples;
  while (same > 1 && log.log.q(same - 1, j) == log.log.q(same - 2, j)) --same;
  if (samples - same < kFewestRepeated || samples - same <= 2 * m.longest_repeat[j]) return;
  const double onset = log.time_s(std::max(same - 1, 1));
  bench.go({FaultKind::stuck_encoder, j + 1, onset, 0.0, {}}, 1);
  lock(onset - 0.5 * log.period_s());
  lock(onset + 0.5 * log.period_s());
}

/// Onsets that a hypothesis may have.
bool may_begin(const CoarseLog& log, double onset_s) {
  return onset_s >= log.time_s(log.first_onset()) && onset_s < log.time_s(log.samples() - 3);
}

/// Moves the onset by halved steps while it explains more.
Judged moved(Judged best, CoarseBench& bench) {
  const CoarseLog& log = bench.log;
  const double period = log.period_s();
  const int rounds = best.guess.kind == FaultKind::locked ? 1 : kRounds;
  int moves = 0;
  double step = period > kLongSample_s ? period : kMove_s;
  while (step > kLeastMove * period && step > kLeastMove_s && moves < kMostMoves) {
    bool better = false;
    for (const double sign : {-1.0, 1.0}) {
      CoarseGuess guess = best.guess;
      guess.onset_s += sign * step;
      guess.start = best.fit.size;
      if (!may_begin(log, guess.onset_s)) continue;
      ++moves;
      Judged now = bench.go(guess, rounds);
      if (now.gain <= best.gain) continue;
      best = std::move(now);
      better = true;
      break;
    }
    if (!better) step *= 0.5;
  }
  return best;
}

/// Steps of Newton on onset and size together.
Judged settled(Judged best, CoarseBench& bench) {
  const CoarseLog& log = bench.log;
  Judged at = best;
  for (int k = 0; k < kNewton; ++k) {
    CoarseGuess guess = at.guess;
    guess.start = at.fit.size;
    double step = 0.0;
    if (!newton_step(log, 0.0, guess, &step)) break;
    at = bench.go(guess, kRounds - 1);
    if (at.gain > best.gain) best = at;
    if (std::abs(step) < kSettled_s) break;
  }
  return best;
}

void refine(const Judged& start, CoarseBench& bench) {
  Judged best = moved(start, bench);
  const FaultKind kind = best.guess.kind;
  if (moves_with_onset(kind)) best = settled(std::move(best), bench);
  if (kind != FaultKind::collision) return;
  for (const double factor : {0.5, 0.7, 1.4, 2.0}) {
    CoarseGuess guess = best.guess;
    guess.start = best.fit.size;
    guess.duration_s *= factor;
    Judged now = bench.go(guess, kRounds - 1);
    if (now.gain > best.gain) best = std::move(now);
  }
}

/// The best of each kind and joint; a free joint and a lost torque are one.
std::vector<Judged> to_refine(const std::vector<Judged>& all) {
  std::vector<Judged> sorted = all, out;
  std::stable_sort(sorted.begin(), sorted.end(), more);
  for (Judged& j : sorted) {
    const bool known = std::any_of(out.begin(), out.end(), [&](const Judged& o) {
      return o.guess.kind == j.guess.kind && o.guess.joint == j.guess.joint;
    });
    if (!known) out.push_back(std::move(j));
    if (out.size() == kMoved) break;
  }
  return out;
}

FaultHypothesis hypothesis_of(const CoarseLog& log, const Judged& judged) {
  FaultHypothesis out;
  out.kind = judged.kind;
  out.joint = judged.guess.joint;
  out.onset_s = judged.guess.onset_s;
  if (judged.guess.duration_s > 0.0) out.end_s = out.onset_s + judged.guess.duration_s;
  out.gain = judged.gain;
  out.size = judged.fit.size;
  out.fit.log_likelihood = judged.fit.log_likelihood;
  out.fit.day = judged.fit.day;
  out.fit.size = judged.fit.size;
  out.fit.left = Eigen::Map<const VectorXd>(judged.fit.left.data(), judged.fit.left.size());
  out.fit.row_gain = 0.5 * (log.healthy.left.cwiseAbs2() - judged.fit.left.cwiseAbs2() - judged.fit.log_ratio)
                               .colwise()
                               .sum()
                               .transpose();
  return out;
}

}  // namespace

LogExplanation explain_coarse(const CoarseLog& log) {
  CoarseBench bench{log, {}, {}};
  judge_candidates(search_coarse(log), bench);
  for (int j = 0; j < log.joints(); ++j) judge_standstill(j, bench);
  for (const Judged& j : to_refine(bench.best)) {
    const FaultKind kind = j.guess.kind;
    const bool fixed = kind == FaultKind::stuck_encoder || kind == FaultKind::sensor_bias ||
                       kind == FaultKind::unknown;  // begins at a sample, or says nothing of its onset
    if (j.gain >= kWorthMoving && !fixed) refine(j, bench);
  }
  LogExplanation out;
  std::stable_sort(bench.best.begin(), bench.best.end(), more);
  for (const Judged& j : bench.best) out.best.push_back(hypothesis_of(log, j));
  out.healthy_square = log.healthy.mean_square();
  return out;
}

EvidenceCourse coarse_course(const CoarseLog& log, const FaultHypothesis& hypothesis) {
  int onset = 0;
  while (onset < log.samples() && log.time_s(onset) < hypothesis.onset_s) ++onset;
  EvidenceCourse out;
  double sum = 0.0;
  for (int k = std::max(0, onset - 1) + 1; k < log.samples(); ++k) {
    sum += hypothesis.fit.row_gain[k];
    out.time_s.push_back(log.time_s(k));
    out.nats.push_back(sum);
  }
  return out;
}

double coarse_misfit(const LogExplanation& e, const FaultHypothesis& h) {
  const double left = h.fit.mean_square();
  const bool much = left > kMuchLeft && left - 1.0 > kUnexplained * (e.healthy_square - 1.0);
  return much ? std::numeric_limits<double>::infinity() : 0.0;
}

}  // namespace faultline
