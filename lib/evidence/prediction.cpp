// SPDX-License-Identifier: MIT
#include "lib/evidence/prediction.hpp"

#include <algorithm>
#include <cmath>

namespace faultline {
namespace {

using Transition = std::array<double, kMaxStates * kMaxStates>;

constexpr double kRestWidths = 3.0;  // friction is uncertain within this many widths of zero velocity
constexpr double kUnknownTorqueTime_s = 0.1;  // an unknown disturbance changes by its scale in this time

JointArray mean_torque(const MotionModel& model, const Step& step) {
  JointArray torque;
  for (int j = 0; j < model.joints(); ++j)
    torque[j] = step.torque[j] + model.torque_phi * (step.next_torque[j] - step.torque[j]);
  return torque;
}

/// Variance of the torque impulse that the model misses at joint j over the step.
double impulse_variance(const MotionModel& model, const Step& step, const GaussianState& state, int j) {
  const ProcessNoise& noise = model.noise;
  const int n = model.joints();
  const double tau = std::max(std::abs(step.torque[j]), std::abs(step.next_torque[j]));
  double variance = noise.floor[j] * noise.floor[j] + noise.torque_share * noise.torque_share * tau * tau;
  const Friction<double>& friction = model.chain.friction[j];
  if (std::abs(state.mean[n + j]) < kRestWidths * friction.width) {
    const double rest = noise.rest_share * friction.coulomb;
    variance += rest * rest;
  }
  const double jump = noise.step_share * (step.next_torque[j] - step.torque[j]);
  variance = step.dt * noise.correlation_s * variance + step.dt * step.dt * jump * jump;
  return variance;
}

/// A joint that an end stop may hold: its velocity may have been stopped or turned within the step.
void allow_end_stops(GaussianState& state, const MotionModel& model, const Step& step) {
  const int n = model.joints();
  for (int j = 0; j < n; ++j) {
    if (!step.pressed || !step.pressed[j]) continue;
    const double push = model.torque_scale[j] * step.dt / model.inertia_scale[j];
    const double variance = state.mean[n + j] * state.mean[n + j] + push * push;
    state.p(n + j, n + j) += variance;
    state.p(j, j) += step.dt * step.dt * variance / 3.0;
    state.p(j, n + j) += 0.5 * step.dt * variance;
    state.p(n + j, j) += 0.5 * step.dt * variance;
  }
}

void add_process_noise(GaussianState& state, const Acceleration& at, const MotionModel& model,
                       const Step& step) {
  const int n = model.joints();
  JointArray variance;
  for (int j = 0; j < n; ++j) variance[j] = impulse_variance(model, step, state, j);
  for (int i = 0; i < n; ++i) {
    for (int k = i; k < n; ++k) {
      double sum = 0.0;
      for (int j = 0; j < n; ++j)
        sum += at.inverse_inertia[i * n + j] * variance[j] * at.inverse_inertia[k * n + j];
      const double half = 0.5 * step.dt * sum, third = step.dt * step.dt * sum / 3.0;
      state.p(n + i, n + k) += sum;
      state.p(i, n + k) += half;
      state.p(n + i, k) += half;
      state.p(i, k) += third;
      if (i == k) continue;
      state.p(n + k, n + i) += sum;
      state.p(k, n + i) += half;
      state.p(n + k, i) += half;
      state.p(k, i) += third;
    }
  }
}

/// V = (1 + dt M^-1 D)^-1 with D the friction slope, by two terms of the series or Gauss-Jordan.
JointSquare velocity_transition(const Acceleration& at, int n, double dt) {
  JointSquare x, v{};
  double largest = 0.0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      x[i * n + j] = dt * at.inverse_inertia[i * n + j] * at.friction_slope[j];
      largest = std::max(largest, std::abs(x[i * n + j]));
    }
  }
  for (int i = 0; i < n; ++i) v[i * n + i] = 1.0;
  if (largest < 0.01) {
    for (int i = 0; i < n * n; ++i) v[i] -= x[i];
    return v;
  }
  for (int i = 0; i < n; ++i) x[i * n + i] += 1.0;
  for (int k = 0; k < n; ++k) {
    const double scale = 1.0 / x[k * n + k];
    for (int j = 0; j < n; ++j) {
      x[k * n + j] *= scale;
      v[k * n + j] *= scale;
    }
    for (int i = 0; i < n; ++i) {
      if (i == k) continue;
      const double factor = x[i * n + k];
      for (int j = 0; j < n; ++j) {
        x[i * n + j] -= factor * x[k * n + j];
        v[i * n + j] -= factor * v[k * n + j];
      }
    }
  }
  return v;
}

Transition analytic_transition(const GaussianState& state, const Acceleration& at, int n, double dt,
                               bool each_joint_has_a_size) {
  Transition a;
  const int size = state.size;
  std::fill_n(a.begin(), size * size, 0.0);
  for (int i = 0; i < size; ++i) a[i * size + i] = 1.0;
  const JointSquare v = velocity_transition(at, n, dt);
  for (int i = 0; i < n; ++i) {
    a[i * size + n + i] = dt;
    for (int j = 0; j < n; ++j) a[(n + i) * size + n + j] = v[i * n + j];
    for (int s = 0; s < size - 2 * n; ++s) {
      double slope = 0.0;
      if (each_joint_has_a_size)
        slope = at.inverse_inertia[i * n + s];
      else
        for (int j = 0; j < n; ++j) slope += at.inverse_inertia[i * n + j] * at.size_torque[s][j];
      a[(n + i) * size + 2 * n + s] = dt * slope;
      a[i * size + 2 * n + s] = 0.5 * dt * dt * slope;
    }
  }
  return a;
}

/// By differences of an integration that is coarser than that of the mean, which a derivative can bear.
Transition numeric_transition(const GaussianState& before, const MotionModel& model,
                              const FaultDynamics& dynamics, const JointArray& torque, double dt,
                              const Hypothesis* hypothesis) {
  Transition a;
  const int n = model.joints(), size = before.size;
  std::fill_n(a.begin(), size * size, 0.0);
  auto integrate = [&](std::array<double, kMaxStates>& x) {
    dynamics.integrate_coarsely(&x[0], &x[n], torque.data(), dt, hypothesis, &x[2 * n]);
  };
  std::array<double, kMaxStates> base = before.mean;
  integrate(base);
  for (int column = 0; column < size; ++column) {
    std::array<double, kMaxStates> moved = before.mean;
    const double delta = 1e-6 * std::max(1.0, std::abs(moved[column]));
    moved[column] += delta;
    integrate(moved);
    for (int row = 0; row < 2 * n; ++row) a[row * size + column] = (moved[row] - base[row]) / delta;
    if (column >= 2 * n) a[column * size + column] = 1.0;
  }
  return a;
}

/// Moves the mean and covariance over the step, without process noise.
Acceleration move(GaussianState& state, const MotionModel& model, const FaultDynamics& dynamics,
                  const Step& step, const Hypothesis* hypothesis) {
  const int n = model.joints();
  const JointArray torque = mean_torque(model, step);
  const GaussianState before = state;
  const Acceleration at = dynamics.integrate(&state.mean[0], &state.mean[n], torque.data(), step.dt,
                                             hypothesis, &state.mean[2 * n]);
  const Transition a =
      step.dt <= kAnalyticStep_s
          ? analytic_transition(state, at, n, step.dt, hypothesis && is_everywhere(*hypothesis))
          : numeric_transition(before, model, dynamics, torque, step.dt, hypothesis);
  propagate_covariance(state, a.data());
  return at;
}

void zero_state(GaussianState& state, int index) {
  state.mean[index] = 0.0;
  for (int i = 0; i < state.size; ++i) state.p(index, i) = state.p(i, index) = 0.0;
}

/// From a fault at the start of the step (`state`) and one at its end (`late`) to one at an unknown moment.
void blend_onset(GaussianState& state, const std::array<double, kMaxStates>& late,
                 const std::array<double, kMaxStates>& prior_variance, int n) {
  std::array<double, kMaxStates> d;
  for (int i = 0; i < 2 * n; ++i) {
    d[i] = state.mean[i] - late[i];
    state.mean[i] = 0.5 * (state.mean[i] + late[i]);
  }
  for (int i = 0; i < 2 * n; ++i) {
    for (int j = 0; j < 2 * n; ++j) {
      double from_sizes = 0.0;  // B P B^T, from the covariance of state and size, which is B P
      for (int s = 2 * n; s < state.size; ++s)
        from_sizes += state.p(i, s) * state.p(j, s) / prior_variance[s];
      state.p(i, j) += d[i] * d[j] / 12.0 - 2.0 / 3.0 * from_sizes;
    }
  }
  for (int i = 0; i < 2 * n; ++i) {
    for (int s = 2 * n; s < state.size; ++s) {
      state.p(i, s) *= 0.5;
      state.p(s, i) *= 0.5;
    }
  }
}

/// Change of velocity when the joint of a locked hypothesis stops: its own, and where the lock is rigid also
/// that of the others.
JointArray stopping(const double* mean, const FaultDynamics& dynamics, const Hypothesis& hypothesis) {
  const int n = dynamics.joints(), joint = hypothesis.joint_index();
  JointArray change{};
  if (hypothesis.variant) change = dynamics.stopping_impulse(mean, mean + n, joint);
  change[joint] = -mean[n + joint];
  return change;
}

bool changes_motion(FaultKind kind) {
  return kind != FaultKind::sensor_bias && kind != FaultKind::sensor_drift &&
         kind != FaultKind::stuck_encoder;
}

/// The pulse of a collision has any shape while it lasts and is over at its duration.
void shape_collision(GaussianState& state, const Hypothesis& hypothesis, double age_s, double dt,
                     const SizePriors& priors, int first) {
  for (int s = first; s < state.size; ++s) {
    const double scale =
        priors.external_torque[hypothesis.label.joint > 0 ? hypothesis.joint_index() : s - first];
    if (age_s > hypothesis.duration_s)
      zero_state(state, s);
    else
      state.p(s, s) += 2.0 * scale * scale * dt / hypothesis.duration_s;
  }
}

}  // namespace

void predict(GaussianState& state, const MotionModel& model, const FaultDynamics& dynamics, const Step& step,
             const Hypothesis* hypothesis, double age_s) {
  const Acceleration at = move(state, model, dynamics, step, hypothesis);
  add_process_noise(state, at, model, step);
  allow_end_stops(state, model, step);
  if (!hypothesis) return;
  if (hypothesis->label.kind == FaultKind::locked)
    zero_state(state, model.joints() + hypothesis->joint_index());
  if (hypothesis->label.kind == FaultKind::collision)
    shape_collision(state, *hypothesis, age_s, step.dt, model.priors, 2 * model.joints());
  if (hypothesis->label.kind == FaultKind::unknown) {
    const double scale = model.priors.external_torque[hypothesis->joint_index()];
    state.p(state.size - 1, state.size - 1) += scale * scale * step.dt / kUnknownTorqueTime_s;
  }
}

void predict_onset(GaussianState& state, const MotionModel& model, const FaultDynamics& dynamics,
                   const Step& step, const Hypothesis& hypothesis) {
  const int n = model.joints();
  if (!changes_motion(hypothesis.label.kind)) return predict(state, model, dynamics, step, nullptr, 0.0);
  const bool locks = hypothesis.label.kind == FaultKind::locked;
  std::array<double, kMaxStates> prior_variance;
  for (int s = 2 * n; s < state.size; ++s) prior_variance[s] = state.p(s, s);
  const JointArray torque = mean_torque(model, step);
  std::array<double, kMaxStates> late = state.mean;  // healthy up to the end of the step
  dynamics.integrate(&late[0], &late[n], torque.data(), step.dt, nullptr, nullptr);
  if (locks) {
    const JointArray early_stop = stopping(state.mean.data(), dynamics, hypothesis);
    const JointArray late_stop = stopping(late.data(), dynamics, hypothesis);
    for (int i = 0; i < n; ++i) {
      state.mean[n + i] += early_stop[i];
      late[n + i] += late_stop[i];
    }
    zero_state(state, n + hypothesis.joint_index());
  }
  predict(state, model, dynamics, step, &hypothesis, 0.0);
  blend_onset(state, late, prior_variance, n);
}

GaussianState with_sizes(const GaussianState& healthy, const Hypothesis& hypothesis,
                         const SizePriors& priors) {
  GaussianState state = extended(healthy, healthy.size + hypothesis.sizes);
  const int j = hypothesis.joint_index(), first = healthy.size;
  auto prior = [&](int index, double mean, double std) {
    state.mean[index] = mean;
    state.p(index, index) = std * std;
  };
  switch (hypothesis.label.kind) {
    case FaultKind::torque_loss:
      prior(first, 0.5, 0.3);
      break;
    case FaultKind::sensor_bias:
      prior(first, 0.0, priors.bias[j]);
      break;
    case FaultKind::sensor_drift:
      prior(first, 0.0, priors.drift[j]);
      break;
    case FaultKind::friction_increase:
      prior(first, priors.viscous_increase[j], priors.viscous_increase[j]);
      prior(first + 1, priors.coulomb_increase[j], priors.coulomb_increase[j]);
      break;
    case FaultKind::payload_change:
      prior(first, 0.0, priors.payload);
      break;
    case FaultKind::collision:
      for (int s = 0; s < hypothesis.sizes; ++s)
        prior(first + s, 0.0, priors.external_torque[j >= 0 ? j : s]);
      break;
    case FaultKind::unknown:
      prior(first, 0.0, priors.external_torque[j]);
      break;
    default:
      break;
  }
  return state;
}

void clamp_sizes(GaussianState& state, const Hypothesis& hypothesis, const MotionModel& model) {
  const int first = 2 * model.joints();
  if (hypothesis.label.kind == FaultKind::torque_loss)
    state.mean[first] = std::clamp(state.mean[first], 0.0, 1.0);
  if (hypothesis.label.kind == FaultKind::friction_increase)
    for (int s = 0; s < 2; ++s) state.mean[first + s] = std::max(state.mean[first + s], 0.0);
  if (hypothesis.label.kind == FaultKind::payload_change)
    state.mean[first] = std::max(state.mean[first], -1.8 * model.priors.payload);
}

}  // namespace faultline
