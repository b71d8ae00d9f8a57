// SPDX-License-Identifier: MIT
#include "lib/balance/one_step/interval_motion.hpp"

#include <array>
#include <cmath>
#include <utility>

#include "lib/balance/one_step/state_count.hpp"

namespace faultline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Weights and places of the four stages of Runge and Kutta.
constexpr std::array<double, 4> kPlace = {0.0, 0.5, 0.5, 1.0}, kWeight = {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6};

constexpr double kConverges = 2.0;  // largest rate times the step for which the Taylor series is good
constexpr int kMostHalvings = 30;   // of a step: ends the loop where a derivative is infinite

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

template <int kStates>
void move_tangent(double h, const MotionSlopes& at, Tangent& tangent) {
  constexpr int n = kStates / 2;
  using Square = Eigen::Matrix<double, kStates, kStates>;
  using Half = Eigen::Matrix<double, kStates, n>;
  using Wide = Eigen::Matrix<double, kStates, kStates + n>;  // by the state, by a torque
  int halvings = 0;  // until the series converges: friction near rest is fast
  for (double size = h * at.by_state.cwiseAbs().maxCoeff(); size > kConverges && halvings < kMostHalvings;
       size *= 0.5)
    ++halvings;
  h = std::ldexp(h, -halvings);
  const Eigen::Matrix<double, n, kStates> slope = at.by_state;
  Wide rate, first = Wide::Zero();
  first.template topRightCorner<n, kStates>().template leftCols<n>().setIdentity();
  first.template bottomLeftCorner<n, kStates>() = slope;
  first.template bottomRightCorner<n, n>() = at.inverse;
  Wide sum = first;
  for (const double order : {4.0, 3.0, 2.0}) {
    sum *= h / order;
    rate.template topRows<n>() = sum.template bottomRows<n>();
    rate.template bottomRows<n>().noalias() = slope.lazyProduct(sum);
    sum = first + rate;
  }
  sum *= h;
  Square step = Square::Identity() + sum.template leftCols<kStates>();
  Half by_torque = sum.template rightCols<n>();
  for (int k = 0; k < halvings; ++k) {
    by_torque += step.lazyProduct(by_torque).eval();
    step = step.lazyProduct(step).eval();
  }
  const Square before = tangent.by_state;
  tangent.by_state = step.lazyProduct(before);
  for (Eigen::Index p = 0; p < tangent.by_number.cols(); ++p) {
    const Eigen::Matrix<double, kStates, 1> number = tangent.by_number.col(p);
    Eigen::Matrix<double, kStates, 1> moved = step.lazyProduct(number);
    for (int j = 0; j < n; ++j)
      if (at.torque(j, p) != 0.0) moved += at.torque(j, p) * by_torque.col(j);
    tangent.by_number.col(p) = moved;
  }
}

}  // namespace

void Tangent::move(double h, const MotionSlopes& at) {
  with_state_count(static_cast<int>(by_state.rows()), [&](auto count) { move_tangent<count>(h, at, *this); });
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
