// SPDX-License-Identifier: MIT
#include "lib/balance/one_step/interval_motion.hpp"

#include <array>
#include <cmath>
#include <utility>

namespace faultline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Weights and places of the four stages of Runge and Kutta.
constexpr std::array<double, 4> kPlace = {0.0, 0.5, 0.5, 1.0}, kWeight = {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6};

constexpr double kConverges = 2.0;  // largest rate times the step for which the Taylor series is good
constexpr int kMostHalvings = 30;

void stop_locked(const MotionLaw& law, VectorXd& state) {
  for (int j = 0; j < law.joints(); ++j)
    if (law.is_locked(j)) state[law.joints() + j] = 0.0;
}

/// Simpson's mean of slopes at begin, middle and end of a step.
void mean_of(const MotionSlopes& begin, const MotionSlopes& middle, const MotionSlopes& end,
             MotionSlopes& out) {
  out.by_state = (begin.by_state + 4.0 * middle.by_state + end.by_state) / 6.0;
  out.inverse = (begin.inverse + 4.0 * middle.inverse + end.inverse) / 6.0;
  out.torque = (begin.torque + 4.0 * middle.torque + end.torque) / 6.0;
}

}  // namespace

void Tangent::move(double h, const MotionSlopes& at) {
  const auto n = at.inverse.rows(), numbers = by_number.cols();
  int halvings = 0;  // until the series converges: friction near rest is fast
  for (double size = h * at.by_state.cwiseAbs().maxCoeff(); size > kConverges && halvings < kMostHalvings;
       size *= 0.5)
    ++halvings;
  h = std::ldexp(h, -halvings);
  using Wide = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 2 * kMaxJoints, 3 * kMaxJoints>;
  Wide rate(2 * n, 3 * n), first(2 * n, 3 * n), sum(2 * n, 3 * n);  // by the state, by a torque
  first.setZero();
  first.topRightCorner(n, 2 * n).leftCols(n).setIdentity();
  first.bottomLeftCorner(n, 2 * n) = at.by_state;
  first.bottomRightCorner(n, n) = at.inverse;
  sum = first;
  for (const double order : {4.0, 3.0, 2.0}) {
    sum *= h / order;
    rate.topRows(n) = sum.bottomRows(n);
    rate.bottomRows(n) = at.by_state.lazyProduct(sum);
    sum = first + rate;
  }
  sum *= h;
  StateMatrix step = StateMatrix::Identity(2 * n, 2 * n) + sum.leftCols(2 * n);
  StateMatrix by_torque = sum.rightCols(n);
  for (int k = 0; k < halvings; ++k) {
    by_torque += step.lazyProduct(by_torque).eval();
    step = step.lazyProduct(step).eval();
  }
  by_state = step.lazyProduct(by_state).eval();
  for (Eigen::Index p = 0; p < numbers; ++p) {
    Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 2 * kMaxJoints, 1> moved = step.lazyProduct(by_number.col(p));
    for (Eigen::Index j = 0; j < n; ++j)
      if (at.torque(j, p) != 0.0) moved += at.torque(j, p) * by_torque.col(j);
    by_number.col(p) = moved;
  }
}

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

Tangent move_with_slopes(const Part& part, const IntervalTorque& torque, int substeps, VectorXd& state) {
  const int n = part.law->joints();
  const double h = (part.end_s - part.begin_s) / substeps;
  stop_locked(*part.law, state);
  Tangent out(2 * n, part.law->body().layout().count());
  for (int j = 0; j < n; ++j)
    if (part.law->is_locked(j)) out.by_state(n + j, n + j) = 0.0;
  MotionSlopes begin, middle, end, mean;
  const auto slopes_at = [&](double at, MotionSlopes& slopes) {
    const JointVector<double> q = state.head(n), dq = state.tail(n), tau = torque.at(at);
    JointVector<double> ddq(n);
    part.law->acceleration(q, dq, tau, ddq);
    part.law->slopes(q, dq, tau, ddq, slopes);
  };
  const auto step_to = [&](int s) {
    const double at = part.begin_s + s * h;
    move({part.law, at - h, at, part.within}, torque, 1, state);
    return at;
  };
  slopes_at(part.begin_s, begin);
  for (int s = 2; s <= substeps; s += 2) {
    slopes_at(step_to(s - 1), middle);
    slopes_at(step_to(s), end);
    mean_of(begin, middle, end, mean);
    out.move(2.0 * h, mean);
    std::swap(begin, end);
  }
  return out;
}

}  // namespace faultline
