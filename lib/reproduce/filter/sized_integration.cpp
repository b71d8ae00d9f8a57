// SPDX-License-Identifier: MIT
// How SizedDynamics goes from one sample to the next.
#include <algorithm>
#include <cmath>

#include "lib/reproduce/filter/sized_dynamics.hpp"

namespace faultline {
namespace {

constexpr int kMostSubsteps = 40;  // in a step: sharper friction than this follows is taken implicitly
constexpr double kStiff = 1.0;     // friction rate times step from which explicit rules need shorter steps

}  // namespace

/// Returns the accelerations at the middle of the step.
Acceleration SizedDynamics::midpoint_step(MotionState& state, const Acceleration& start,
                                          const JointArray& torque, double h) const {
  MotionState middle;
  for (int j = 0; j < joints_; ++j) {
    middle.dq[j] = state.dq[j] + 0.5 * h * start.value[j];
    middle.q[j] = state.q[j] + 0.5 * h * state.dq[j];
  }
  const Acceleration at = evaluate(middle, torque, true);
  for (int j = 0; j < joints_; ++j) {
    state.q[j] += h * middle.dq[j];
    state.dq[j] += h * at.value[j];
  }
  return at;
}

void SizedDynamics::implicit_step(MotionState& state, const Acceleration& at, double h) const {
  const int n = joints_;
  JointSquare system;  // (1 + h/2 M^-1 D) dv = h a, D the friction slope: second order, stable however stiff
  JointArray change;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j)
      system[i * n + j] =
          (i == j ? 1.0 : 0.0) + 0.5 * h * at.inverse_inertia[i * n + j] * at.friction_slope[j];
    change[i] = h * at.value[i];
  }
  for (int k = 0; k < n; ++k) {
    for (int i = k + 1; i < n; ++i) {
      const double factor = system[i * n + k] / system[k * n + k];
      for (int j = k; j < n; ++j) system[i * n + j] -= factor * system[k * n + j];
      change[i] -= factor * change[k];
    }
  }
  for (int i = n - 1; i >= 0; --i) {
    for (int j = i + 1; j < n; ++j) change[i] -= system[i * n + j] * change[j];
    change[i] /= system[i * n + i];
  }
  for (int j = 0; j < n; ++j) {
    state.q[j] += h * (state.dq[j] + 0.5 * change[j]);
    state.dq[j] += change[j];
  }
}

void SizedDynamics::runge_kutta_step(MotionState& state, const JointArray& torque, double h) const {
  // The classical rule of fourth order: where its stages stand in the step, and their weights.
  static constexpr double kFraction[4] = {0.0, 0.5, 0.5, 1.0};
  static constexpr double kWeight[4] = {1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0};
  const int n = joints_;
  MotionState at_stage{};
  JointArray v{}, a{}, sum_v{}, sum_a{};
  for (int stage = 0; stage < 4; ++stage) {
    for (int j = 0; j < n; ++j) {
      at_stage.q[j] = state.q[j] + kFraction[stage] * h * v[j];
      at_stage.dq[j] = state.dq[j] + kFraction[stage] * h * a[j];
    }
    const Acceleration at = evaluate(at_stage, torque, false);
    for (int j = 0; j < n; ++j) {
      v[j] = at_stage.dq[j];
      a[j] = at.value[j];
      sum_v[j] += kWeight[stage] * v[j];
      sum_a[j] += kWeight[stage] * a[j];
    }
  }
  for (int j = 0; j < n; ++j) {
    state.q[j] += h * sum_v[j];
    state.dq[j] += h * sum_a[j];
  }
}

void SizedDynamics::advance(MotionState& state, const Acceleration& at, double h) const {
  if (at.stiffness * h > kStiff) return implicit_step(state, at, h);
  for (int j = 0; j < joints_; ++j) {
    state.q[j] += h * (state.dq[j] + 0.5 * h * at.value[j]);
    state.dq[j] += h * at.value[j];
  }
}

int SizedDynamics::substeps(const Acceleration& at, double dt, double longest_s) {
  const double wanted = std::max(dt / longest_s, at.stiffness * dt / kStiff);
  return std::clamp(static_cast<int>(std::ceil(wanted)), 1, kMostSubsteps);
}

bool SizedDynamics::is_stiff(const Acceleration& at, double h) { return at.stiffness * h > kStiff; }

Acceleration SizedDynamics::integrate(MotionState& state, const JointArray& torque, double dt) const {
  const bool is_short = dt <= kShortStep_s;
  Acceleration first = evaluate(state, torque, !is_short && dt <= kAnalyticStep_s);
  if (is_short && !is_stiff(first, dt)) return midpoint_step(state, first, torque, dt);
  if (is_short) first = evaluate(state, torque, true);
  const int steps = substeps(first, dt, kLongestSubstep_s);
  const double h = dt / steps;
  if (!is_stiff(first, h)) {
    for (int step = 0; step < steps; ++step) runge_kutta_step(state, torque, h);
  } else {
    implicit_step(state, first, h);
    for (int step = 1; step < steps; ++step) implicit_step(state, evaluate(state, torque, false), h);
  }
  return first;
}

}  // namespace faultline
