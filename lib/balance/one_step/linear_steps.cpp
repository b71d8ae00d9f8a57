// SPDX-License-Identifier: MIT
#include "lib/balance/one_step/linear_steps.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace faultline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kTurn = 0.1;                // rad of a joint in a substep: leaves some 1e-6 of a state
constexpr double kMostSubsteps_Hz = 2000.0;  // for a velocity that is no velocity
constexpr double kNearRest = 5.0;            // widths of the friction: beyond, tanh is 1 but for 1e-4
constexpr double kShortest_s = 1e-12;        // part of an interval that is worth integrating

/// Part of an interval that one law moves.
struct Part {
  const MotionLaw* law = nullptr;
  double begin_s = 0.0, end_s = 0.0;  ///< from the interval's start
  bool within = false;                ///< the other law
};

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

/// The torque within one interval.
struct IntervalTorque {
  JointVector<double> begin, slope;  ///< at its start, and by the time

  JointVector<double> at(double s) const { return begin + s * slope; }
};

IntervalTorque torque_of(const UniformLog& log, int k, const StepSetting& setting, const MotionPlan& plan) {
  IntervalTorque out;
  out.begin = log.tau.row(k).transpose();
  if (plan.force != nullptr) out.begin += plan.force->col(k);
  out.slope = JointVector<double>::Zero(log.joints());
  if (!setting.torque_is_held && k + 1 < log.rows())
    out.slope = (log.tau.row(k + 1) - log.tau.row(k)).transpose() / setting.period_s;
  return out;
}

/// Weights and places of the four stages of Runge and Kutta.
constexpr std::array<double, 4> kPlace = {0.0, 0.5, 0.5, 1.0}, kWeight = {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6};

/// Substeps of an interval, as fast motion and friction that changes its sign ask for.
int substeps_of(const StepSetting& setting, const MotionPlan& plan, const VectorXd& begin,
                const VectorXd& end) {
  const MotionBody& body = plan.usual->body();
  const int n = plan.usual->joints();
  double per_s = 1.0 / setting.substep_s;
  for (int j = 0; j < n; ++j)
    if (body.rigid().chain.geometry[j].kind == AxisKind::revolute)
      per_s = std::max(per_s, std::abs(begin[n + j]) / kTurn);
  for (const MotionLaw* law : {plan.usual, plan.within}) {
    if (law == nullptr) continue;
    const JointVector<double> rate = law->friction_rate(begin.head(n));
    for (int j = 0; j < n; ++j)
      if (share_near_rest(begin[n + j], end[n + j], body.friction_width()[j]) > 0.0)
        per_s = std::max(per_s, rate[j]);
  }
  return std::max(1,
                  static_cast<int>(std::ceil(setting.period_s * std::min(per_s, kMostSubsteps_Hz) - 1e-9)));
}

void stop_locked(const MotionLaw& law, VectorXd& state) {
  for (int j = 0; j < law.joints(); ++j)
    if (law.is_locked(j)) state[law.joints() + j] = 0.0;
}

/// Moves the state through one part.
void move(const Part& part, const IntervalTorque& torque, int substeps, VectorXd& state) {
  const int n = part.law->joints();
  const double h = (part.end_s - part.begin_s) / substeps;
  stop_locked(*part.law, state);
  JointVector<double> q(n), dq(n), ddq(n);
  VectorXd rate = VectorXd::Zero(2 * n), sum(2 * n);
  for (int s = 0; s < substeps; ++s) {
    const double at = part.begin_s + s * h;
    sum.setZero();
    for (int stage = 0; stage < 4; ++stage) {
      q = state.head(n) + kPlace[stage] * h * rate.head(n);
      dq = state.tail(n) + kPlace[stage] * h * rate.tail(n);
      part.law->acceleration(q, dq, torque.at(at + kPlace[stage] * h), ddq);
      rate << dq, ddq;
      sum += kWeight[stage] * rate;
    }
    state += h * sum;
  }
}

/// Work space of a linearised part.
struct Scratch {
  MatrixXd slopes, tangent, rate, sum, at;
};

/// Moves the state and its derivatives `tangent` (states x (states + numbers)) through one part: those of the
/// Runge-Kutta steps themselves.
void move_with_slopes(const Part& part, const IntervalTorque& torque, int substeps, VectorXd& state,
                      Scratch& w) {
  const int n = part.law->joints(), numbers = part.law->body().layout().count();
  const double h = (part.end_s - part.begin_s) / substeps;
  stop_locked(*part.law, state);
  w.tangent.setZero(2 * n, 2 * n + numbers);
  w.tangent.leftCols(2 * n).setIdentity();
  for (int j = 0; j < n; ++j)
    if (part.law->is_locked(j)) w.tangent(n + j, n + j) = 0.0;
  JointVector<double> q(n), dq(n), ddq(n);
  VectorXd rate = VectorXd::Zero(2 * n), sum(2 * n);
  w.rate.setZero(2 * n, 2 * n + numbers);
  for (int s = 0; s < substeps; ++s) {
    const double at = part.begin_s + s * h;
    sum.setZero();
    w.sum.setZero(2 * n, 2 * n + numbers);
    for (int stage = 0; stage < 4; ++stage) {
      const double step = kPlace[stage] * h;
      const JointVector<double> tau = torque.at(at + step);
      q = state.head(n) + step * rate.head(n);
      dq = state.tail(n) + step * rate.tail(n);
      part.law->acceleration(q, dq, tau, ddq);
      part.law->slopes(q, dq, tau, ddq, w.slopes);
      w.at = w.tangent + step * w.rate;
      w.rate.topRows(n) = w.at.bottomRows(n);
      w.rate.bottomRows(n).noalias() = w.slopes.leftCols(2 * n) * w.at;
      w.rate.bottomRightCorner(n, numbers) += w.slopes.rightCols(numbers);
      rate << dq, ddq;
      sum += kWeight[stage] * rate;
      w.sum += kWeight[stage] * w.rate;
    }
    state += h * sum;
    w.tangent += h * w.sum;
  }
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
                         const MotionPlan& plan, const LinearSteps* known) {
  LinearSteps out;
  const int states = out.states = static_cast<int>(about.rows());
  const int numbers = out.numbers = plan.usual->body().layout().count();
  const int intervals = out.intervals = static_cast<int>(about.cols()) - 1;
  out.slope.resize(states, states * intervals);
  out.miss.resize(states, intervals);
  out.number.resize(states, numbers * intervals);
  out.within_begin = out.within_end = intervals;
  Scratch w;
  for (int k = 0; k < intervals; ++k) {
    const Parts parts = parts_of(log.time_s(k), setting.period_s, plan);
    const bool touched = parts.count > 1 || parts.part[0].within;
    if (touched && out.within_begin == intervals) {
      out.within_begin = k;
      out.within.setZero(states, numbers * (intervals - k));
    }
    if (touched) out.within_end = k + 1;
    auto slope = out.slope.middleCols(k * states, states);
    auto number = out.number.middleCols(k * numbers, numbers);
    if (known != nullptr && !touched) {
      slope = known->slope_of(k);
      number = known->number_of(k);
      out.miss.col(k) = known->miss.col(k);
      continue;
    }
    const IntervalTorque torque = torque_of(log, k, setting, plan);
    VectorXd state = about.col(k);
    const int substeps = substeps_of(setting, plan, state, about.col(k + 1));
    slope.setIdentity();
    number.setZero();
    for (int p = 0; p < parts.count; ++p) {
      move_with_slopes(parts.part[p], torque, substeps, state, w);
      const auto by_state = w.tangent.leftCols(states);
      const auto by_number = w.tangent.rightCols(numbers);
      slope = (by_state * slope).eval();
      number = (by_state * number + by_number).eval();
      if (!touched) continue;
      auto within = out.within.middleCols((k - out.within_begin) * numbers, numbers);
      within = (by_state * within).eval();
      if (parts.part[p].within) within += by_number;
    }
    out.miss.col(k) = state - about.col(k + 1);
  }
  return out;
}

VectorXd next_state(const UniformLog& log, int k, const Trajectory& about, const StepSetting& setting,
                    const MotionPlan& plan) {
  const Parts parts = parts_of(log.time_s(k), setting.period_s, plan);
  const IntervalTorque torque = torque_of(log, k, setting, plan);
  VectorXd state = about.col(k);
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
