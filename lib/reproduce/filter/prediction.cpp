// SPDX-License-Identifier: MIT
#include "lib/reproduce/filter/prediction.hpp"

#include <algorithm>
#include <cmath>

#include "lib/core/elementary/elementary.hpp"
#include "lib/evidence/size_scale.hpp"
#include "lib/reproduce/filter/process_noise.hpp"
#include "lib/reproduce/filter/transition.hpp"

namespace faultline {
namespace {

// Of a share of the step that is uniform in 0..1: its variance is 1/12, its mean square 1/3, where a fault of
// the whole step has 1.
constexpr double kUniformSpread = 12.0;
constexpr double kSizeExcess = 2.0 / 3.0;
constexpr double kWanderingTime_s = 0.1;  // a size that wanders changes by its scale in this time

JointArray mean_torque(const MotionModel& model, const Step& step) {
  JointArray torque;
  for (int j = 0; j < model.joints(); ++j)
    torque[j] = step.torque[j] + model.torque_phi * (step.next_torque[j] - step.torque[j]);
  return torque;
}

/// Moves the mean and covariance over the step, without process noise.
Acceleration move(GaussianState& state, const MotionModel& model, const FaultDynamics& dynamics,
                  const Step& step, const Hypothesis* hypothesis) {
  const int n = model.joints();
  const JointArray torque = mean_torque(model, step);
  StateVector before;
  std::copy_n(state.mean.begin(), state.size, before.begin());
  MotionState motion = motion_of(state.mean, n);
  const Acceleration at = dynamics.integrate(motion, torque, step.dt,
                                             circumstances(state.mean, model, hypothesis, step.drive_level));
  set_motion(state.mean, motion, n);
  const MotionRows a = step.dt <= kAnalyticStep_s
                           ? analytic_transition(state, at, model, step.dt, hypothesis)
                           : stepwise_transition(before, state.size, model, dynamics, torque,
                                                 step.drive_level, step.dt, hypothesis);
  propagate_covariance(state, a, 2 * n);
  return at;
}

/// Share of a slow state's distance from its usual value that is left after the step. What wanders and yet
/// stays within a day's spread forgets where it was. The pace of friction is matched to a walk without end.
double kept_over(const SlowState& slow, double dt) {
  if (slow.memory_s > 0.0) return elementary::exp(-dt / slow.memory_s);
  if (slow.kind == SlowKind::friction || !(slow.day_std > 0.0)) return 1.0;
  const double pace = slow.walk / slow.day_std;
  return 1.0 / (1.0 + 0.5 * pace * pace * dt);
}

/// What the healthy robot's slow states do over the step: all wander around what is usual.
void move_slow_states(GaussianState& state, const MotionModel& model, double dt) {
  for (std::size_t s = 0; s < model.slow.size(); ++s) {
    const SlowState& slow = model.slow[s];
    const int index = 2 * model.joints() + static_cast<int>(s);
    const double kept = kept_over(slow, dt);
    if (kept == 1.0) {
      state.p(index, index) += slow.walk * slow.walk * dt;
      continue;
    }
    state.mean[index] -= slow.usual;
    relax(state, index, kept);
    state.mean[index] += slow.usual;
    state.p(index, index) += slow.day_std * slow.day_std * (1.0 - kept * kept);
  }
}

void zero_state(GaussianState& state, int index) {
  state.mean[index] = 0.0;
  for (int i = 0; i < state.size; ++i) state.p(index, i) = state.p(i, index) = 0.0;
}

/// From a fault at the start of the step (`state`) and one at its end (`late`) to one at an unknown moment.
void blend_onset(GaussianState& state, const StateVector& late, const StateVector& prior_variance, int n,
                 int first_size) {
  StateVector d;
  for (int i = 0; i < 2 * n; ++i) {
    d[i] = state.mean[i] - late[i];
    state.mean[i] = 0.5 * (state.mean[i] + late[i]);
  }
  for (int i = 0; i < 2 * n; ++i) {
    for (int j = 0; j < 2 * n; ++j) {
      double from_sizes = 0.0;  // B P B^T, from the covariance of state and size, which is B P
      for (int s = first_size; s < state.size; ++s)
        from_sizes += state.p(i, s) * state.p(j, s) / prior_variance[s];
      state.p(i, j) += d[i] * d[j] / kUniformSpread - kSizeExcess * from_sizes;
    }
  }
  for (int i = 0; i < 2 * n; ++i) {
    for (int s = first_size; s < state.size; ++s) {
      state.p(i, s) *= 0.5;
      state.p(s, i) *= 0.5;
    }
  }
}

/// Change of velocity when the joint of a locked hypothesis stops: its own, and where the lock is rigid also
/// that of the others.
JointArray stopping(const MotionState& motion, const FaultDynamics& dynamics, const Hypothesis& hypothesis) {
  const int joint = hypothesis.joint_index();
  JointArray change{};
  if (hypothesis.form == HypothesisForm::rigid_lock) change = dynamics.stopping_impulse(motion, joint);
  change[joint] = -motion.dq[joint];
  return change;
}

/// What the sizes do over the step: most stay what they are; a pulse has any shape while it lasts and is over
/// at its duration.
void move_sizes(GaussianState& state, const Hypothesis& hypothesis, double age_s, double dt,
                const MotionModel& model) {
  const SizeCourse course = describe(hypothesis.label.kind).course;
  if (course == SizeCourse::stays) return;
  for (int s = 0; s < hypothesis.sizes; ++s) {
    const int index = model.healthy_states() + s;
    const double scale =
        prior_scale(model.priors, described_size(hypothesis, s).measure, joint_of_size(hypothesis, s));
    if (course == SizeCourse::wanders)
      state.p(index, index) += scale * scale * dt / kWanderingTime_s;
    else if (age_s > hypothesis.duration_s)
      zero_state(state, index);
    else
      state.p(index, index) += 2.0 * scale * scale * dt / hypothesis.duration_s;
  }
}

}  // namespace

void predict(GaussianState& state, const MotionModel& model, const FaultDynamics& dynamics, const Step& step,
             const Hypothesis* hypothesis, double age_s) {
  const Acceleration at = move(state, model, dynamics, step, hypothesis);
  move_slow_states(state, model, step.dt);
  add_process_noise(state, at, model, step);
  allow_springs(state, model, step);
  allow_end_stops(state, model, step);
  if (!hypothesis) return;
  if (hypothesis->label.kind == FaultKind::locked)
    zero_state(state, model.joints() + hypothesis->joint_index());
  move_sizes(state, *hypothesis, age_s, step.dt, model);
}

void predict_onset(GaussianState& state, const MotionModel& model, const FaultDynamics& dynamics,
                   const Step& step, const Hypothesis& hypothesis) {
  const int n = model.joints();
  if (describe(hypothesis.label.kind).acts_on != FaultActsOn::motion)
    return predict(state, model, dynamics, step, nullptr, 0.0);
  const bool locks = hypothesis.label.kind == FaultKind::locked;
  const int first_size = model.healthy_states();
  StateVector prior_variance;
  for (int s = first_size; s < state.size; ++s) prior_variance[s] = state.p(s, s);
  const JointArray torque = mean_torque(model, step);
  const MotionState early = motion_of(state.mean, n);
  MotionState late = early;  // healthy up to the end of the step
  dynamics.integrate(late, torque, step.dt, circumstances(state.mean, model, nullptr));
  if (locks) {
    const JointArray early_stop = stopping(early, dynamics, hypothesis);
    const JointArray late_stop = stopping(late, dynamics, hypothesis);
    for (int i = 0; i < n; ++i) {
      state.mean[n + i] += early_stop[i];
      late.dq[i] += late_stop[i];
    }
    zero_state(state, n + hypothesis.joint_index());
  }
  predict(state, model, dynamics, step, &hypothesis, 0.0);
  StateVector late_mean;
  set_motion(late_mean, late, n);
  blend_onset(state, late_mean, prior_variance, n, first_size);
}

GaussianState with_sizes(const GaussianState& healthy, const Hypothesis& hypothesis,
                         const SizePriors& priors) {
  GaussianState state = extended(healthy, healthy.size + hypothesis.sizes);
  for (int s = 0; s < hypothesis.sizes; ++s) {
    const FaultSize& size = described_size(hypothesis, s);
    const double scale = prior_scale(priors, size.measure, joint_of_size(hypothesis, s));
    const double std = size.prior_std * scale;
    state.mean[healthy.size + s] = size.prior_mean * scale;
    state.p(healthy.size + s, healthy.size + s) = std * std;
  }
  return state;
}

void clamp_sizes(GaussianState& state, const Hypothesis& hypothesis, const MotionModel& model) {
  for (int s = 0; s < hypothesis.sizes; ++s) {
    const FaultSize& size = described_size(hypothesis, s);
    const double scale = prior_scale(model.priors, size.measure, joint_of_size(hypothesis, s));
    double& mean = state.mean[model.healthy_states() + s];
    mean = std::clamp(mean, size.low * scale, size.high * scale);
  }
}

}  // namespace faultline
