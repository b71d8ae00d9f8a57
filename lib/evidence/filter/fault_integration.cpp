// SPDX-License-Identifier: MIT
// How FaultDynamics goes from one sample to the next.
#include <algorithm>
#include <cmath>

#include "lib/evidence/filter/fault_dynamics.hpp"

namespace faultline {
namespace {

constexpr int kMostSubsteps = 40;  // in a step: sharper friction than this follows is taken implicitly
constexpr double kCoarseSubstep_s = 0.025;
constexpr double kStiff = 1.0;  // friction rate times step from which explicit rules need shorter steps

}  // namespace

/// Returns the accelerations at the middle of the step.
Acceleration FaultDynamics::midpoint_step(MotionState& state, const Acceleration& start,
                                          const JointArray& torque, double h, const SizedFault& fault) const {
  MotionState middle;
  for (int j = 0; j < joints_; ++j) {
    middle.dq[j] = state.dq[j] + 0.5 * h * start.value[j];
    middle.q[j] = state.q[j] + 0.5 * h * state.dq[j];
  }
  const Acceleration at = evaluate(middle, torque, fault);
  for (int j = 0; j < joints_; ++j) {
    state.q[j] += h * middle.dq[j];
    state.dq[j] += h * at.value[j];
  }
  return at;
}

void FaultDynamics::implicit_step(MotionState& state, const Acceleration& at, double h) const {
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

void FaultDynamics::runge_kutta_step(MotionState& state, const JointArray& torque, double h,
                                     const SizedFault& fault) const {
  // The classical rule of fourth order: where its stages stand in the step, and their weights.
  static constexpr double kFraction[4] = {0.0, 0.5, 0.5, 1.0};
  static constexpr double kWeight[4] = {1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0};
  const int n = joints_;
  MotionState at_stage;
  JointArray v{}, a{}, sum_v{}, sum_a{};
  for (int stage = 0; stage < 4; ++stage) {
    for (int j = 0; j < n; ++j) {
      at_stage.q[j] = state.q[j] + kFraction[stage] * h * v[j];
      at_stage.dq[j] = state.dq[j] + kFraction[stage] * h * a[j];
    }
    const Acceleration at = evaluate(at_stage, torque, fault);
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

Acceleration FaultDynamics::integrate(MotionState& state, const JointArray& torque, double dt,
                                      const SizedFault& fault) const {
  const Acceleration first = evaluate(state, torque, fault);
  const bool stiff = first.stiffness * dt > kStiff;
  if (dt <= kShortStep_s && !stiff) return midpoint_step(state, first, torque, dt, fault);
  const double wanted = std::max(dt / kLongestSubstep_s, first.stiffness * dt / kStiff);
  const int steps = std::clamp(static_cast<int>(std::ceil(wanted)), 1, kMostSubsteps);
  const double h = dt / steps;
  if (first.stiffness * h <= kStiff) {
    for (int step = 0; step < steps; ++step) runge_kutta_step(state, torque, h, fault);
  } else {
    implicit_step(state, first, h);
    for (int step = 1; step < steps; ++step) implicit_step(state, evaluate(state, torque, fault), h);
  }
  return first;
}

void FaultDynamics::integrate_coarsely(MotionState& state, const JointArray& torque, double dt,
                                       const SizedFault& fault) const {
  Acceleration at = evaluate(state, torque, fault);
  const double wanted = std::max(dt / kCoarseSubstep_s, at.stiffness * dt / kStiff);
  const int steps = std::clamp(static_cast<int>(std::ceil(wanted)), 1, kMostSubsteps);
  const double h = dt / steps;
  for (int step = 0; step < steps; ++step) {
    if (step > 0) at = evaluate(state, torque, fault);
    if (at.stiffness * h <= kStiff)
      midpoint_step(state, at, torque, h, fault);
    else
      implicit_step(state, at, h);
  }
}

}  // namespace faultline
