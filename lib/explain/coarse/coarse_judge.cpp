// SPDX-License-Identifier: MIT
#include "lib/explain/coarse/coarse_judge.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "lib/balance/regress.hpp"
#include "lib/balance/rows.hpp"
#include "lib/core/elementary/elementary.hpp"
#include "lib/explain/hypothesis.hpp"
#include "lib/explain/search/sensor_jumps.hpp"
#include "lib/robot/dynamics.hpp"

namespace faultline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kUnknownForce = 30.0;  // times the usual torque (std): exceeds any force that a robot meets
constexpr double kOnsetNudge_s = 1e-4;  // s, of the numeric derivative by the onset
constexpr double kHolds = 4.0;          // mean square of residuals, up to which its trajectory is used next,
constexpr double kHoldsShare = 0.05;    // or share of the mean square of the healthy robot
constexpr double kAbsurd = 1e6;       // derivative of a state by the one before: the integration has diverged
constexpr double kMostColumns = 4.0;  // prior standard deviations: bound of a size that a round starts from
constexpr double kTorqueForState = 15.0;   // a torque error of 3 % changes a state by some .2 % a sample
constexpr double kMostLossOfStart = 1.05;  // share of the torque lost that a round starts from, at most
constexpr double kSettled_nats = 0.05;     // nats: a round that changes less is the last
constexpr double kMostPayload = 2.5;       // times the mass that the link carries: the same for a payload
constexpr double kCodesMove = 1e12;        // nats of a stuck encoder whose codes do not repeat
constexpr double kUnreadSample = 0.7;      // nats of each sample that a stuck encoder excludes

/// Returns what a false reading of size 1 adds to the measurements (2 joints x samples) from sample `from`
/// on.
Eigen::MatrixXd read_column(const CoarseLog& log, const CoarseGuess& guess, int from) {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(log.read.rows(), log.samples());
  const int j = guess.joint.index(), n = log.joints();
  for (int k = from; k < log.samples(); ++k) {
    out(j, k) = guess.kind == FaultKind::sensor_bias ? 1.0 : log.time_s(k) - guess.onset_s;
    if (guess.kind == FaultKind::sensor_drift && !guess.velocity_is_true) out(n + j, k) = 1.0;
  }
  return out;
}

/// Values about which one round linearises a hypothesis, and steps that are known.
struct Setup {
  VectorXd day, size;  ///< about which it is linear; `size` empty: not known yet
  Trajectory about;
  std::shared_ptr<const CoarseSteps> known{};  ///< of the same law, day and size
  bool is_first = true;  ///< about the healthy robot's trajectory, whose steps are known
};

/// Inputs of the regression of one round.
struct Linearised {
  LinearSteps steps;
  FilterInput input;
  VectorXd precision, about;  ///< of the unknowns' prior, and the values that they are corrections to
};

double end_of(const CoarseGuess& guess) {
  return guess.duration_s > 0.0 ? guess.onset_s + guess.duration_s : 1e300;
}

/// Returns the numbers of the robot on this day with a fault of this size; without it if there is no size.
VectorXd numbers_with(const CoarseLog& log, const VectorXd& day, const FaultDirections& fault,
                      const VectorXd& size) {
  VectorXd out = log.numbers + log.day * day;
  if (fault.std.size() > 0 && size.size() > 0) out += fault.direction * size;
  return out;
}

JointMatrix inertia_at(const CoarseLog& log, int sample) {
  const RigidColumns& rigid = log.model->body.rigid();
  return inertia_matrix(chain_of(rigid, log.numbers.head(rigid.base())),
                        JointVector(log.about.col(sample).head(log.joints())));
}

/// Returns the covariance of the prediction error. A joint that locks halts at an uncertain moment, and the
/// speeds of the joints coupled to it jump.
MatrixXd process_of(const CoarseLog& log, const CoarseGuess& guess, const LinearSteps& steps, int from,
                    double tolerated_share) {
  const int n = log.joints(), j = guess.joint.index();
  MatrixXd std = tolerated_force(log, tolerated_share);
  if (guess.kind == FaultKind::unknown)
    std.row(j)
        .tail(steps.intervals - std::max(0, from - 1))
        .setConstant(kUnknownForce * log.model->torque_rms[j]);
  MatrixXd out = process_covariance(steps, log.model->layout(), std);
  if (guess.kind != FaultKind::locked || from <= 0 || from >= log.samples()) return out;
  auto block = out.middleCols((from - 1) * steps.states, steps.states);
  const JointMatrix inertia = inertia_at(log, from - 1);
  const double rest = log.time_s(from) - guess.onset_s;  // for which a jump of a velocity acts
  for (int i = 0; i < n; ++i) {
    if (i == j || inertia(i, j) == 0.0) continue;
    const auto speed = log.about.row(n + i);
    const double jump = (speed.array() - speed.mean()).square().mean();
    block(i, i) += rest * rest * jump;
    block(i, n + i) += rest * jump;
    block(n + i, i) += rest * jump;
    block(n + i, n + i) += jump;
  }
  const double slip = 0.5 * log.period_s() * std::abs(log.about(n + j, from - 1)) + 1e-5;
  block(j, j) += 4.0 * slip * slip;
  return out;
}

/// Writes the column of the onset: what a later onset changes in the interval that contains it, per second.
void add_onset_column(const CoarseLog& log, const MotionPlan& plan, const CoarseGuess& guess,
                      const Trajectory& about, MatrixXd& column, int columns) {
  const int k =
      std::clamp(static_cast<int>(std::floor((guess.onset_s - log.log.start_s) / log.period_s() + 1e-9)), 0,
                 log.samples() - 2);
  MotionPlan later = plan;
  later.begin_s += kOnsetNudge_s;
  const VectorXd now = next_state(log.log, k, about, log.model->setting, plan);
  const VectorXd then = next_state(log.log, k, about, log.model->setting, later);
  column.col(k * columns + columns - 1) = (then - now) / kOnsetNudge_s;
}

/// Returns the inputs of a round; empty if the integration diverges.
std::optional<Linearised> linearise(const CoarseLog& log, const CoarseGuess& guess, const Setup& at,
                                    const CoarseJudging& how) {
  const OneStepModel& m = *log.model;
  const int n = log.joints(), j = guess.joint.index(), from = log.log.first_row(guess.onset_s);
  const FaultDirections fault = fault_directions(m, guess.kind, guess.joint);
  const bool reading = falsifies_position(guess.kind);
  const int sizes = static_cast<int>(fault.std.size()), effects = static_cast<int>(log.day.cols());
  const VectorXd usual = numbers_with(log, at.day, {}, {});
  const MotionLaw healthy(m.body, usual);
  const MotionLaw faulty(m.body, numbers_with(log, at.day, fault, reading ? VectorXd() : at.size),
                         guess.kind == FaultKind::locked ? 1u << j : 0u);
  const bool moves = sizes > 0 || guess.kind == FaultKind::locked;
  const MotionPlan plan{&healthy, moves ? &faulty : nullptr, guess.onset_s, end_of(guess)};
  Linearised out;
  KnownSteps known;
  if (at.known) {
    known = {&at.known->steps, &at.known->about};
    if (moves) known.begin_s = at.known->begin_s, known.end_s = at.known->end_s;
  } else if (at.is_first && log.healthy_steps.intervals > 0) {
    known = {&log.healthy_steps, &log.about};
    known.laws_are_alike = guess.kind != FaultKind::locked && at.size.size() == 0;
  }
  out.steps = linear_steps(log.log, at.about, m.setting, plan, known);
  if (!out.steps.miss.allFinite() || !out.steps.slope.allFinite()) return std::nullopt;
  if (out.steps.slope.cwiseAbs().maxCoeff() >= kAbsurd) return std::nullopt;
  FilterInput& in = out.input;
  const int extra = (reading ? 1 : 0) + (how.move_onset ? 1 : 0), columns = effects + sizes + extra;
  MatrixXd directions = MatrixXd::Zero(m.layout().count(), sizes + extra);
  if (sizes > 0) directions.leftCols(sizes) = fault.direction;
  in.column = out.steps.columns(log.day, directions);
  if (how.move_onset) add_onset_column(log, plan, guess, at.about, in.column, columns);
  in.process = process_of(log, guess, out.steps, from, how.tolerated_share);
  in.variance = log.variance.colwise() + tolerated_variance(m, how.tolerated_share);
  if (guess.kind == FaultKind::stuck_encoder) {
    const JointMatrix inertia = inertia_at(log, std::max(0, from - 1));
    for (int i = 0; i < n; ++i) {
      if (inertia(i, j) == 0.0) continue;  // joint j is not measured, so joint i cannot be predicted
      in.variance.row(i).tail(log.samples() - from).setConstant(kMissingReading);
      in.variance.row(n + i).tail(log.samples() - from).setConstant(kMissingReading);
    }
  }
  in.reading = log.read - at.about;
  out.precision.resize(columns);
  out.about = VectorXd::Zero(columns);
  out.precision.head(effects) = m.day_variance.cwiseInverse();
  out.about.head(effects) = at.day;
  if (sizes > 0) out.precision.segment(effects, sizes) = fault.std.cwiseAbs2().cwiseMax(1e-24).cwiseInverse();
  if (reading) {
    in.read_column = effects;
    in.read = read_column(log, guess, from);
    if (at.size.size() > 0) in.reading -= at.size[0] * in.read;
    out.precision[effects] = 1.0 / Eigen::numext::abs2(prior_of_sizes(m, guess.kind, guess.joint)[0]);
  }
  if (at.size.size() > 0) out.about.segment(effects, at.size.size()) = at.size;
  if (how.move_onset) out.precision[columns - 1] = 1.0 / (log.period_s() * log.period_s());
  return out;
}

/// An explanation, and what the smoothed trajectory follows from.
struct Regressed {
  CoarseExplanation explanation;
  Innovations filter;
  VectorXd change;  ///< of the unknowns, from the values about which the round is linear
};

/// Solves the regression over the innovations for the values of the unknowns.
Regressed regressed(const CoarseLog& log, const CoarseGuess& guess, const Linearised& lin,
                    const CoarseJudging& how) {
  Innovations filter = innovations(lin.steps, lin.input);
  const int effects = static_cast<int>(log.day.cols()), columns = filter.columns;
  const Eigen::Map<const VectorXd> keep(log.keep.data(), log.keep.size());
  const MatrixXd x = keep.asDiagonal() * filter.white.rightCols(columns);
  const VectorXd y = keep.cwiseProduct(filter.white.col(0));
  // Unknowns are taken as values, not as corrections: their prior is about zero.
  const Regression fit = regress(normal_equations(x, y + x * lin.about), lin.precision);
  VectorXd change = fit.estimate - lin.about;
  CoarseExplanation out;
  out.left = y - x * change;
  out.variance = filter.variance;
  const MatrixXd& usual = log.healthy.variance;
  const bool healthy = guess.kind == FaultKind::none || usual.size() == 0;
  out.log_ratio = MatrixXd::Zero(filter.states, filter.samples);
  double missing = 0.0;
  for (int k = 0; k < filter.samples; ++k)
    for (int i = 0; i < filter.states; ++i) {
      if (log.keep(i, k) == 0.0) continue;
      const double v = out.variance(i, k);
      if (std::isnan(v)) {
        missing += 1.0;
      } else if (!healthy) {
        out.log_ratio(i, k) = elementary::log(v / (std::isnan(usual(i, k)) ? 1.0 : usual(i, k)));
      }
    }
  out.log_likelihood = fit.log_likelihood - 0.5 * missing - 0.5 * out.log_ratio.sum();
  out.day = fit.estimate.head(effects);
  out.size = fit.estimate.segment(effects, columns - effects - (how.move_onset ? 1 : 0));
  out.size_covariance = fit.covariance(effects, out.size.size());
  if (how.move_onset) out.onset_step_s = fit.estimate[columns - 1];
  if (guess.kind == FaultKind::none) out.day_column = x.leftCols(effects);
  return {std::move(out), std::move(filter), std::move(change)};
}

VectorXd within_reason(const CoarseLog& log, const CoarseGuess& guess, const VectorXd& size) {
  const VectorXd std = prior_of_sizes(*log.model, guess.kind, guess.joint);
  VectorXd out = size.cwiseMax(-kMostColumns * std).cwiseMin(kMostColumns * std);
  if (guess.kind == FaultKind::torque_loss) out[0] = std::clamp(out[0], 0.0, kMostLossOfStart);
  if (guess.kind == FaultKind::payload_change)
    out[0] = std::clamp(out[0], 0.0, kMostPayload * log.model->carried_kg[guess.joint.index()]);
  return out;
}

/// Returns the values about which the next round linearises: the smoothed trajectory, if it holds.
Setup next_round(const CoarseLog& log, const CoarseGuess& guess, const Setup& at, const LinearSteps& steps,
                 const Regressed& now) {
  const CoarseExplanation& e = now.explanation;
  const double much = log.healthy.left.size() > 0 ? kHoldsShare * log.healthy.mean_square() : 0.0;
  const bool holds = e.mean_square() < std::max(kHolds, much);
  Setup next{e.day, e.size, log.about, {}, false};
  if (holds) next.about = at.about + smoothed(steps, now.filter, now.change);
  if (falsifies_position(guess.kind) && !holds)
    next.about -= e.size[0] * read_column(log, guess, log.log.first_row(guess.onset_s));
  if (e.size.size() > 0) next.size = within_reason(log, guess, e.size);
  return next;
}

/// Returns the share of the samples from `from` on, without two, that repeat the position before.
double share_repeated(const CoarseLog& log, int j, int from) {
  const int first = std::min(from + 2, log.samples() - 1);
  return log.samples() - from > 3
             ? static_cast<double>(repeats(log.log, j, first, log.samples())) / (log.samples() - first)
             : 0.0;
}

/// Returns the nats of a first false code that does not repeat the last true one: it may be any position that
/// the joint passed since, while a true measurement lies within its noise.
double price_of_new_code(const CoarseLog& log, int j, int from) {
  if (from < 1) return 0.0;
  const double passed = std::abs(log.log.q(from, j) - log.log.q(from - 1, j));
  const double noise = std::sqrt(2.0 * std::numbers::pi * log.model->reading_variance[j]);
  return passed > noise ? elementary::log(passed / noise) : 0.0;
}

double price_of_friction(const CoarseLog& log, int j, const CoarseExplanation& fit, int from) {
  double power = 0.0;  // that the added friction takes
  for (int k = from; k < log.samples(); ++k) {
    const double v = log.about(log.joints() + j, k);
    power += (fit.size[0] * v + fit.size[1] * elementary::tanh(v / log.model->body.friction_width()[j])) * v;
  }
  return log.samples() - from < 2 || power <= 0.0 ? kNoSuchSize : 0.0;
}

/// Returns the price of a guess in nats beside its residuals: for sizes that its kind does not have, for
/// measurements and forces that it excludes, for codes that repeat or do not. `from` is its first sample.
double coarse_price(const CoarseLog& log, const CoarseGuess& guess, const CoarseExplanation& fit, int from) {
  const int j = guess.joint.index(), late = log.samples() - from;
  switch (guess.kind) {
    case FaultKind::torque_loss:
      return (fit.size[0] < 0.0 ? kNoSuchSize : 0.0) + kBeyondLoss * std::max(0.0, fit.size[0] - kMostLoss);
    case FaultKind::payload_change:
      return fit.size[0] < 0.0 ? kNoSuchSize : 0.0;
    case FaultKind::friction_increase:
      return price_of_friction(log, j, fit, from);
    case FaultKind::stuck_encoder: {
      if (share_repeated(log, j, from) < kStuckShare) return kCodesMove;
      const double kept = log.keep.row(j).tail(late).sum();
      const double evidence = repeats_are_evidence(*log.model, j)
                                  ? std::min(repeats(log.log, j, from, log.samples()), kMostRepeats) *
                                        elementary::log(1.0 / log.model->repeat_share[j])
                                  : 0.0;
      return kStillJoint + kUnreadSample * kept + price_of_new_code(log, j, from) - evidence;
    }
    case FaultKind::locked:
      return kStillJoint + (share_repeated(log, j, from) > kStuckShare && repeats_are_evidence(*log.model, j)
                                ? kRepeatedReading * late
                                : 0.0);
    case FaultKind::unknown:
      return kStillJoint + kForcedRow * late;
    default:
      return 0.0;
  }
}

}  // namespace

CoarseGuess guess_of(const FaultClaim& claim) {
  return {column_kind(claim.kind),
          claim.joint,
          claim.onset_s,
          claim.end_s < kNeverEnds ? claim.end_s - claim.onset_s : 0.0,
          claim.size,
          claim.velocity_is_true};
}

VectorXd tolerated_variance(const OneStepModel& m, double tolerated_share) {
  VectorXd range(2 * m.joints());
  range << m.q_high - m.q_low, m.top_speed;
  return (tolerated_share * range).cwiseAbs2();
}

MatrixXd tolerated_force(const CoarseLog& log, double tolerated_share) {
  MatrixXd out = log.force_std;
  for (int i = 0; i < out.rows(); ++i)
    for (int k = 0; k < out.cols(); ++k)
      out(i, k) = log.stop(i, k) > 0.0
                      ? kUnknownForce * log.model->torque_rms[i]
                      : elementary::hypot(out(i, k), kTorqueForState * tolerated_share * log.log.tau(k, i));
  return out;
}

std::optional<CoarseExplanation> judge_coarse(const CoarseLog& log, const CoarseGuess& guess,
                                              const CoarseJudging& how) {
  const int n = log.joints(), j = guess.joint.index(), from = log.log.first_row(guess.onset_s);
  const int late = log.samples() - from;
  const bool locked = guess.kind == FaultKind::locked && late > 0;
  Setup at{VectorXd::Zero(log.day.cols()), guess.start, log.about};
  const bool same_rest = how.known && log.log.first_row(how.known->begin_s) == from;
  if (how.known && (!locked || same_rest))
    at = {how.known->day, how.known->size, how.known->about, how.known, false};
  if (at.size.size() > 0) at.size = within_reason(log, guess, at.size);
  const double rest = locked ? log.read.row(j).tail(late).mean() : 0.0;
  std::optional<CoarseExplanation> best;
  for (int round = 0; round < how.rounds; ++round) {
    if (locked) {
      at.about.row(j).tail(late).setConstant(at.known ? at.known->about(j, log.samples() - 1) : rest);
      at.about.row(n + j).tail(late).setZero();
    }
    std::optional<Linearised> lin = linearise(log, guess, at, how);
    if (!lin) break;
    Regressed now = regressed(log, guess, *lin, how);
    const double gained = best ? now.explanation.log_likelihood - best->log_likelihood
                               : std::numeric_limits<double>::infinity();
    const bool is_last = round + 1 == how.rounds || std::abs(gained) < kSettled_nats;
    Setup next = is_last ? Setup{} : next_round(log, guess, at, lin->steps, now);
    if (gained > 0.0) {
      best = std::move(now.explanation);
      best->steps = std::make_shared<const CoarseSteps>(CoarseSteps{
          at.day, at.size, std::move(at.about), std::move(lin->steps), guess.onset_s, end_of(guess)});
    }
    if (is_last) break;
    at = std::move(next);
  }
  if (best) best->log_likelihood -= coarse_price(log, guess, *best, from);
  return best;
}

}  // namespace faultline
