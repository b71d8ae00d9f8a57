// SPDX-License-Identifier: MIT
#include "lib/balance/one_step/linear_steps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace faultline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kTurn = 0.1;  // rad of a joint in a substep: relative error of a state some 1e-6
constexpr double kMostSubsteps_Hz = 2000.0;  // bound for implausible velocities
constexpr double kNearRest = 5.0;            // widths of the friction, beyond which tanh is 1 within 1e-4
constexpr double kShortest_s = 1e-12;        // shortest part of an interval that is integrated

/// Nodes and weights of the four stages of Runge and Kutta.
constexpr std::array<double, 4> kPlace = {0.0, 0.5, 0.5, 1.0}, kWeight = {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6};

constexpr double kConverges = 2.0;  // largest rate times step for which the Taylor series needs no halving
constexpr int kMostHalvings = 30;   // of a step: ends the loop if a derivative is infinite

/// Part of an interval in which one law of motion holds.
struct Part {
  const MotionLaw* law = nullptr;
  double begin_s = 0.0, end_s = 0.0;  ///< from the interval's start
  bool within = false;                ///< the law is MotionPlan::within
};

/// Torque within one interval.
struct IntervalTorque {
  JointVector begin, slope;  ///< at its start, and its derivative by time

  JointVector at(double s) const { return begin + s * slope; }
};

/// Derivatives of the state at some time by an earlier state and by each number of the law.
struct Tangent {
  StateMatrix by_state;
  Eigen::MatrixXd by_number;

  Tangent(int states, int numbers)
      : by_state(StateMatrix::Identity(states, states)), by_number(Eigen::MatrixXd::Zero(states, numbers)) {}
};

void stop_locked(const MotionLaw& law, StateVector& state) {
  for (int j = 0; j < law.joints(); ++j)
    if (law.is_locked(j)) state[law.joints() + j] = 0.0;
}

/// Writes Simpson's mean of the slopes at begin, middle and end of a step to `out`.
void mean_of(const MotionSlopes& begin, const MotionSlopes& middle, const MotionSlopes& end,
             MotionSlopes& out) {
  out.by_state = (begin.by_state + 4.0 * middle.by_state + end.by_state) / 6.0;
  out.inverse = (begin.inverse + 4.0 * middle.inverse + end.inverse) / 6.0;
  out.torque = (begin.torque + 4.0 * middle.torque + end.torque) / 6.0;
}

/// Advances the derivatives by a step of length `h`, s, with constant slopes: the Taylor series of fourth
/// order of the exponential, with steps that are halved, then doubled, if it would not converge (Moler and
/// Van Loan 2003, method 3).
template <int kStates>
void move_tangent(double h, const MotionSlopes& at, Tangent& tangent) {
  constexpr int kJoints = kJointsOf<kStates>, kWide = kStates == Eigen::Dynamic ? kStates : 3 * kJoints;
  using Square = SmallMatrix<kStates, kStates>;
  using State = SmallMatrix<kStates, 1>;
  using Wide = SmallMatrix<kStates, kWide>;  // by the state, by a torque
  const int count = static_cast<int>(tangent.by_state.rows()), joints = count / 2;
  const auto states = Eigen::fix<kStates>(count);
  const auto n = Eigen::fix<kJoints>(joints);
  int halvings = 0;  // until the series converges: friction near rest is fast
  for (double size = h * at.by_state.cwiseAbs().maxCoeff(); size > kConverges && halvings < kMostHalvings;
       size *= 0.5)
    ++halvings;
  h = std::ldexp(h, -halvings);
  const SmallMatrix<kJoints, kStates> slope = at.by_state;
  Wide rate(count, 3 * joints), first = Wide::Zero(count, 3 * joints);
  first.topRightCorner(n, states).leftCols(n).setIdentity();
  first.bottomLeftCorner(n, states) = slope;
  first.bottomRightCorner(n, n) = at.inverse;
  Wide sum = first;
  for (const double order : {4.0, 3.0, 2.0}) {
    sum *= h / order;
    rate.topRows(n) = sum.bottomRows(n);
    rate.bottomRows(n).noalias() = slope.lazyProduct(sum);
    sum = first + rate;
  }
  sum *= h;
  Square step = Square::Identity(count, count) + sum.leftCols(states);
  SmallMatrix<kStates, kJoints> by_torque = sum.rightCols(n);
  for (int k = 0; k < halvings; ++k) {
    by_torque += step.lazyProduct(by_torque).eval();
    step = step.lazyProduct(step).eval();
  }
  const Square before = tangent.by_state;
  tangent.by_state = step.lazyProduct(before);
  for (Eigen::Index p = 0; p < tangent.by_number.cols(); ++p) {
    const State number = tangent.by_number.col(p);
    State moved = step.lazyProduct(number);
    for (int j = 0; j < joints; ++j)
      if (at.torque(j, p) != 0.0) moved += at.torque(j, p) * by_torque.col(j);
    tangent.by_number.col(p) = moved;
  }
}

JointVector acceleration_at(const MotionLaw& law, const StateVector& state, const JointVector& torque) {
  JointVector ddq;
  law.acceleration(state.head(law.joints()), state.tail(law.joints()), torque, ddq);
  return ddq;
}

/// Advances the state from time `at` by a Runge-Kutta step of fourth order; `ddq` is its acceleration there.
void advance(const MotionLaw& law, const IntervalTorque& torque, double at, double h, const JointVector& ddq,
             StateVector& state) {
  const int n = law.joints();
  StateVector rate(2 * n);
  rate << state.tail(n), ddq;
  StateVector sum = kWeight[0] * rate;
  for (int stage = 1; stage < 4; ++stage) {
    const StateVector there = state + kPlace[stage] * h * rate;
    rate << there.tail(n), acceleration_at(law, there, torque.at(at + kPlace[stage] * h));
    sum += kWeight[stage] * rate;
  }
  state += h * sum;
}

/// Integrates the state through one part.
void move(const Part& part, const IntervalTorque& torque, int substeps, StateVector& state) {
  const double h = (part.end_s - part.begin_s) / substeps;
  stop_locked(*part.law, state);
  for (int s = 0; s < substeps; ++s) {
    const double at = part.begin_s + s * h;
    advance(*part.law, torque, at, h, acceleration_at(*part.law, state, torque.at(at)), state);
  }
}

/// Integrates likewise and returns the derivatives. One of their steps spans two of the state; its slopes are
/// Simpson's mean of those before, between and after the two. `substeps` is even.
Tangent move_with_slopes(const Part& part, const IntervalTorque& torque, int substeps, StateVector& state) {
  const MotionLaw& law = *part.law;
  const int n = law.joints();
  const double h = (part.end_s - part.begin_s) / substeps;
  stop_locked(law, state);
  Tangent out(2 * n, law.body().layout().count());
  for (int j = 0; j < n; ++j)
    if (law.is_locked(j)) out.by_state(n + j, n + j) = 0.0;
  MotionSlopes begin, middle, end, mean;
  JointVector ddq;
  const auto slopes_at = [&](double at, MotionSlopes& slopes) {
    law.acceleration_and_slopes(state.head(n), state.tail(n), torque.at(at), ddq, slopes);
  };
  slopes_at(part.begin_s, begin);
  for (int s = 0; s < substeps; s += 2) {
    const double first = part.begin_s + s * h, second = part.begin_s + (s + 1) * h;
    advance(law, torque, first, h, ddq, state);
    slopes_at(second, middle);
    advance(law, torque, second, h, ddq, state);
    slopes_at(part.begin_s + (s + 2) * h, end);
    mean_of(begin, middle, end, mean);
    with_state_count(2 * n, [&](auto count) { move_tangent<count>(2.0 * h, mean, out); });
    std::swap(begin, end);
  }
  return out;
}

struct Parts {
  std::array<Part, 3> part;
  int count = 0;
};

Parts parts_of(double start_s, double period_s, const MotionPlan& plan) {
  Parts out;
  const double a = std::clamp(plan.begin_s - start_s, 0.0, period_s),
               b = std::max(a, std::clamp(plan.end_s - start_s, 0.0, period_s));
  const auto add = [&](double from, double to, bool within) {
    if (to - from > kShortest_s)
      out.part[out.count++] = {within ? plan.within : plan.usual, from, to, within};
  };
  if (plan.within == nullptr || b - a <= kShortest_s) {
    add(0.0, period_s, false);
    return out;
  }
  add(0.0, a, false);
  add(a, b, true);
  add(b, period_s, false);
  return out;
}

IntervalTorque torque_of(const UniformLog& log, int k, const StepSetting& setting, const MotionPlan& plan) {
  IntervalTorque out;
  out.begin = log.tau.row(k).transpose();
  if (plan.force != nullptr) out.begin += plan.force->col(k);
  out.slope = JointVector::Zero(log.joints());
  if (!setting.torque_is_held && k + 1 < log.rows())
    out.slope = (log.tau.row(k + 1) - log.tau.row(k)).transpose() / setting.period_s;
  return out;
}

/// Returns the number of substeps of an interval, which is even: more for fast motion and for friction near
/// its change of sign.
int substeps_of(const StepSetting& setting, const MotionPlan& plan, const StateVector& begin,
                const StateVector& end) {
  const MotionBody& body = plan.usual->body();
  const int n = plan.usual->joints();
  double per_s = 1.0 / setting.substep_s;
  for (int j = 0; j < n; ++j)
    if (body.rigid().chain.geometry[j].kind == AxisKind::revolute)
      per_s = std::max(per_s, std::abs(begin[n + j]) / kTurn);
  for (const MotionLaw* law : {plan.usual, plan.within}) {
    if (law == nullptr) continue;
    const JointVector rate = law->friction_rate(begin.head(n));
    for (int j = 0; j < n; ++j)
      if (share_near_rest(begin[n + j], end[n + j], body.friction_width()[j]) > 0.0)
        per_s = std::max(per_s, rate[j]);
  }
  const double pairs = 0.5 * setting.period_s * std::min(per_s, kMostSubsteps_Hz);
  return 2 * std::max(1, static_cast<int>(std::ceil(pairs - 1e-9)));
}

/// Copies interval `k`, whose parts are `now`, from the known steps. Returns false if these do not hold.
bool take_known(const UniformLog& log, const Trajectory& about, const StepSetting& setting,
                const MotionPlan& plan, const Parts& now, const KnownSteps& known, int k, LinearSteps& out) {
  if (known.steps == nullptr) return false;
  const Parts then =
      parts_of(log.time_s(k), setting.period_s, {plan.usual, plan.within, known.begin_s, known.end_s});
  if (now.count > 1 || then.count > 1) return false;
  const bool is_other = now.part[0].within, was_other = then.part[0].within;
  if (is_other != was_other && !(is_other && known.laws_are_alike)) return false;
  if (known.about != &about &&
      (known.about->col(k) != about.col(k) || known.about->col(k + 1) != about.col(k + 1)))
    return false;
  const LinearSteps& steps = *known.steps;
  out.slope.middleCols(k * out.states, out.states) = steps.slope_of(k);
  out.number.middleCols(k * out.numbers, out.numbers) = steps.number_of(k);
  out.miss.col(k) = steps.miss.col(k);
  if (is_other) out.within.middleCols((k - out.within_begin) * out.numbers, out.numbers) = steps.number_of(k);
  return true;
}

}  // namespace

MatrixXd LinearSteps::columns(const MatrixXd& throughout, const MatrixXd& other) const {
  const int n = static_cast<int>(throughout.cols()), m = static_cast<int>(other.cols());
  MatrixXd out = MatrixXd::Zero(states, (n + m) * intervals);
  for (int k = 0; k < intervals; ++k) {
    out.middleCols(k * (n + m), n).noalias() = number_of(k) * throughout;
    if (k >= within_begin && k < within_end && m > 0)
      out.middleCols(k * (n + m) + n, m).noalias() =
          within.middleCols((k - within_begin) * numbers, numbers) * other;
  }
  return out;
}

LinearSteps linear_steps(const UniformLog& log, const Trajectory& about, const StepSetting& setting,
                         const MotionPlan& plan, const KnownSteps& known) {
  LinearSteps out;
  const int states = out.states = static_cast<int>(about.rows());
  const int numbers = out.numbers = plan.usual->body().layout().count();
  const int intervals = out.intervals = static_cast<int>(about.cols()) - 1;
  out.slope.resize(states, states * intervals);
  out.miss.resize(states, intervals);
  out.number.resize(states, numbers * intervals);
  out.within_begin = out.within_end = intervals;
  for (int k = 0; k < intervals; ++k) {
    const Parts parts = parts_of(log.time_s(k), setting.period_s, plan);
    const bool touched = parts.count > 1 || parts.part[0].within;
    if (touched && out.within_begin == intervals) {
      out.within_begin = k;
      out.within.setZero(states, numbers * (intervals - k));
    }
    if (touched) out.within_end = k + 1;
    if (take_known(log, about, setting, plan, parts, known, k, out)) continue;
    auto slope = out.slope.middleCols(k * states, states);
    auto number = out.number.middleCols(k * numbers, numbers);
    const IntervalTorque torque = torque_of(log, k, setting, plan);
    StateVector state = about.col(k);
    const int substeps = substeps_of(setting, plan, state, about.col(k + 1));
    for (int p = 0; p < parts.count; ++p) {
      const Tangent moved = move_with_slopes(parts.part[p], torque, substeps, state);
      if (p == 0) {
        slope = moved.by_state;
        number = moved.by_number;
      } else {
        slope = moved.by_state.lazyProduct(slope).eval();
        number = (moved.by_state.lazyProduct(number) + moved.by_number).eval();
      }
      if (!touched) continue;
      auto within = out.within.middleCols((k - out.within_begin) * numbers, numbers);
      if (p > 0) within = moved.by_state.lazyProduct(within).eval();
      if (parts.part[p].within) within += moved.by_number;
    }
    out.miss.col(k) = state - about.col(k + 1);
  }
  return out;
}

VectorXd next_state(const UniformLog& log, int k, const Trajectory& about, const StepSetting& setting,
                    const MotionPlan& plan) {
  const Parts parts = parts_of(log.time_s(k), setting.period_s, plan);
  const IntervalTorque torque = torque_of(log, k, setting, plan);
  StateVector state = about.col(k);
  const int substeps = substeps_of(setting, plan, state, about.col(k + 1));
  for (int p = 0; p < parts.count; ++p) move(parts.part[p], torque, substeps, state);
  return state;
}

double share_near_rest(double begin, double end, double friction_width) {
  const double near = kNearRest * friction_width;
  const double low = std::min(begin, end), high = std::max(begin, end);
  const double within = std::min(high, near) - std::max(low, -near);
  if (within < 0.0) return 0.0;
  return high - low < 1e-12 ? 1.0 : within / (high - low);
}

}  // namespace faultline
