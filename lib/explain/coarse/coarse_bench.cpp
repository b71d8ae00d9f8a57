// SPDX-License-Identifier: MIT
#include "lib/explain/coarse/coarse_bench.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace faultline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kSameSamples = 3;  // between two onsets that count as one
/// Shares of each state tolerated as errors of a wrong onset: a fifth each time.
constexpr std::array<double, 4> kToleratedInTurn = {kFirstTolerated, 1e-3, 2e-4, 4e-5};
constexpr int kStepsForEach = 2;           // steps of Newton at each of these shares, at most
constexpr double kNearSize = 0.2;          // relative difference of sizes that can share their steps
constexpr double kUnexplained = 0.3;       // share of the healthy robot's excess over noise: more is unknown
constexpr double kLeastDuration_s = 1e-3;  // shortest duration of a fault
// Longest Newton step of an onset: share of a long sample; s for short samples.
constexpr double kMostNewton = 0.7, kMostNewton_s = 0.03;

/// Returns whether steps about one size can replace those about another one.
bool are_near(const VectorXd& a, const VectorXd& b) {
  return a.size() == b.size() && (a - b).norm() < kNearSize * b.norm();
}

/// Moves the guess towards its best onset and size. Errors of a wrong onset are tolerated at first, then less
/// and less, so that Newton steps converge from a sample away.
CoarseGuess approached(const CoarseLog& log, CoarseGuess guess, std::shared_ptr<const CoarseSteps> known) {
  for (const double tolerated_share : kToleratedInTurn)
    for (int k = 0; k < kStepsForEach; ++k) {
      if (known && !are_near(known->size, guess.start)) known.reset();
      const std::optional<NewtonStep> step =
          newton_step(log, guess, {.move_onset = true, .tolerated_share = tolerated_share, .known = known});
      if (!step) return guess;
      guess = step->guess;
      known = step->steps;
      if (std::abs(step->onset_step_s) < kSettled_s) break;
    }
  return guess;
}

/// Returns the evidence of a judged guess from its onset on, against the healthy robot with the effects `day`
/// of the day: those of the best guess, so that all courses have one reference. The healthy robot's own
/// effects are biased by the fault, so that rows before the fault would be evidence, too.
EvidenceCourse course_of(const CoarseLog& log, const JudgedGuess& judged, const VectorXd& day) {
  const CoarseExplanation &healthy = log.healthy, &fit = judged.fit;
  const VectorXd bent = healthy.day_column * (day - healthy.day),
                 more = (healthy.left - bent).cwiseAbs2() - fit.left.cwiseAbs2();
  const Eigen::Map<const MatrixXd> by_sample(more.data(), fit.log_ratio.rows(), fit.log_ratio.cols());
  const MatrixXd gain = 0.5 * (by_sample - fit.log_ratio);
  const VectorXd by_row = gain.colwise().sum().transpose();
  EvidenceCourse out;
  double sum = 0.0;
  for (int k = std::max(1, log.log.first_row(judged.guess.onset_s)); k < log.samples(); ++k) {
    sum += by_row[k];
    out.time_s.push_back(log.time_s(k));
    out.nats.push_back(sum);
  }
  return out;
}

FaultHypothesis hypothesis_of(const CoarseLog& log, const JudgedGuess& judged, const VectorXd& day) {
  FaultHypothesis out;
  out.kind = judged.kind;
  out.joint = judged.guess.joint;
  if (out.kind == FaultKind::collision) {  // of the joint with the greatest force, relative to its torque
    int j = 0;
    judged.fit.size.cwiseQuotient(log.model->torque_rms).cwiseAbs().maxCoeff(&j);
    out.joint = Joint::at(j);
  }
  out.onset_s = judged.guess.onset_s;
  if (judged.guess.duration_s > 0.0) out.end_s = out.onset_s + judged.guess.duration_s;
  out.gain = judged.gain;
  out.size = judged.fit.size;
  out.fit = judged.fit;
  out.course = course_of(log, judged, day);
  const double left = out.fit.mean_square();
  if (left > kLargeResidual && left - 1.0 > kUnexplained * (log.healthy.mean_square() - 1.0))
    out.misfit = std::numeric_limits<double>::infinity();
  return out;
}

}  // namespace

bool moves_with_onset(FaultKind kind) {
  return kind != FaultKind::sensor_bias && kind != FaultKind::sensor_drift &&
         kind != FaultKind::stuck_encoder && kind != FaultKind::unknown;
}

CoarseGuess with_times_moved(CoarseGuess guess, double onset_step_s, double end_step_s) {
  if (guess.duration_s > 0.0) {
    onset_step_s = std::min(onset_step_s, guess.duration_s - kLeastDuration_s);
    guess.duration_s = std::max(kLeastDuration_s, guess.duration_s + end_step_s - onset_step_s);
  }
  guess.onset_s += onset_step_s;
  return guess;
}

std::optional<NewtonStep> newton_step(const CoarseLog& log, CoarseGuess guess, const CoarseJudging& how) {
  const double most = log.period_s() > kLongSample_s ? kMostNewton * log.period_s() : kMostNewton_s;
  const std::optional<CoarseExplanation> fit = judge_coarse(log, guess, how);
  if (!fit) return std::nullopt;
  const double onset_s = std::clamp(guess.onset_s + std::clamp(fit->onset_step_s, -most, most),
                                    log.time_s(log.first_onset()), log.time_s(log.samples() - 3));
  guess = with_times_moved(guess, onset_s - guess.onset_s, 0.0);
  guess.start = fit->size;
  return NewtonStep{std::move(guess), fit->onset_step_s, fit->steps};
}

std::optional<JudgedGuess> CoarseBench::go(const CoarseGuess& guess, int rounds,
                                           const std::shared_ptr<const CoarseSteps>& known) {
  std::optional<JudgedGuess> out = judge_and_keep(guess, rounds, known);
  if (guess.kind != FaultKind::sensor_drift || guess.velocity_is_true || log.log.dq.rows() == 0) return out;
  CoarseGuess apart = guess;
  apart.velocity_is_true = true;
  std::optional<JudgedGuess> other = judge_and_keep(apart, rounds, {});
  return !out || (other && other->gain > out->gain) ? other : out;
}

std::optional<JudgedGuess> CoarseBench::judge_and_keep(const CoarseGuess& guess, int rounds,
                                                       const std::shared_ptr<const CoarseSteps>& known) {
  tried.push_back(guess);
  std::optional<CoarseExplanation> fit = judge_coarse(log, guess, {.rounds = rounds, .known = known});
  if (!fit) return std::nullopt;
  JudgedGuess out{guess, guess.kind, fit->log_likelihood - log.healthy.log_likelihood, std::move(*fit)};
  if (guess.kind == FaultKind::unknown) out.gain -= kFormShare * kFormShare * std::max(0.0, out.gain);
  if (guess.kind == FaultKind::torque_loss && out.fit.size[0] > kFreeShare)
    out.kind = FaultKind::free_swinging;
  const auto kept = std::ranges::find_if(
      best, [&](const JudgedGuess& o) { return o.kind == out.kind && o.guess.joint == out.guess.joint; });
  if (kept == best.end())
    best.push_back(out);
  else if (out.gain > kept->gain)
    *kept = out;
  return out;
}

void CoarseBench::go_near(const CoarseGuess& guess, const std::shared_ptr<const CoarseSteps>& known) {
  if (moves_with_onset(guess.kind)) go(approached(log, guess, known), 1);
}

void CoarseBench::integrate_best() {
  const auto winner = std::ranges::max_element(best, {}, &JudgedGuess::gain);
  if (winner == best.end()) return;
  const bool is_any = winner->fit.mean_square() > kLargeResidual;
  const double enough = kMayWin * winner->gain;
  for (const JudgedGuess& j : std::vector<JudgedGuess>(best))
    if ((is_any || j.gain > enough) && j.kind != FaultKind::unknown)  // that implies the smoothed trajectory
      judge_and_keep(j.guess, kCoarseRounds, j.fit.steps);
}

bool CoarseBench::tried_near(FaultKind kind, Joint joint, double onset_s) const {
  return std::ranges::any_of(tried, [&](const CoarseGuess& g) {
    return g.kind == kind && g.joint == joint &&
           std::abs(g.onset_s - onset_s) < kSameSamples * log.period_s();
  });
}

double CoarseBench::best_gain() const {
  double out = 0.0;
  for (const JudgedGuess& j : best) out = std::max(out, j.gain);
  return out;
}

LogExplanation CoarseBench::explanation() const {
  LogExplanation out;
  const auto winner = std::ranges::max_element(best, {}, &JudgedGuess::gain);
  for (const JudgedGuess& j : best) out.best.push_back(hypothesis_of(log, j, winner->fit.day));
  std::ranges::stable_sort(out.best, std::ranges::greater{}, &FaultHypothesis::gain);
  out.healthy_square = log.healthy.mean_square();
  return out;
}

}  // namespace faultline
