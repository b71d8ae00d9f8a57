// SPDX-License-Identifier: MIT
#include "lib/reproduce/filter/process_noise.hpp"

#include <algorithm>
#include <cmath>

namespace faultline {
namespace {

// Of the largest torque: what a torque that was not logged may be off by.
constexpr double kMissingShare = 0.5;
constexpr double kUnseenJump = 0.5;  // of a jump larger than any healthy one: what may have been missed
// Friction is uncertain within this many widths of zero velocity, where its tanh is not yet 1 (to 0.5 %).
constexpr double kRestWidths = 3.0;

/// White noise of acceleration over dt that gives the velocity the variance v gives the position v dt^2 / 3
/// (and v dt / 2 between them).
constexpr double kIntegratedNoise = 3.0;

bool is_set(std::span<const bool> flags, int j) { return !flags.empty() && flags[j]; }

/// What is not known of a torque that jumps between two samples. Healthy jumps tell how much; of a larger
/// one, such as a controller's answer to a reading that is wrong, nobody knows how long it lasted.
double missed_of_jump(const MotionModel& model, double jump, int j) {
  const double share = model.noise.step_share;
  if (share == 0.0 || model.torque_jump.empty()) return share * jump;
  const double usual = std::min(jump, model.torque_jump[j]);
  return share * usual + std::max(share, kUnseenJump) * (jump - usual);
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
  if (is_set(step.torque_missing, j) || is_set(step.next_torque_missing, j)) {
    const double guess = kMissingShare * model.torque_scale[j];
    return step.dt * step.dt * guess * guess;
  }
  const double jump = missed_of_jump(model, std::abs(step.next_torque[j] - step.torque[j]), j);
  variance = step.dt * noise.correlation_s * variance + step.dt * step.dt * jump * jump;
  return variance;
}

}  // namespace

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
      const double half = 0.5 * step.dt * sum, third = step.dt * step.dt * sum / kIntegratedNoise;
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

void allow_springs(GaussianState& state, const MotionModel& model, const Step& step) {
  for (std::size_t j = 0; j < model.noise.compliance.size(); ++j) {
    const double jump = model.noise.compliance[j] * (step.next_torque[j] - step.torque[j]);
    const int joint = static_cast<int>(j);
    state.p(joint, joint) += jump * jump;
  }
}

void allow_end_stops(GaussianState& state, const MotionModel& model, const Step& step) {
  const int n = model.joints();
  for (int j = 0; j < n; ++j) {
    if (!is_set(step.pressed, j)) continue;
    const double push = model.torque_scale[j] * step.dt / model.inertia_scale[j];
    const double variance = state.mean[n + j] * state.mean[n + j] + push * push;
    state.p(n + j, n + j) += variance;
    state.p(j, j) += step.dt * step.dt * variance / kIntegratedNoise;
    state.p(j, n + j) += 0.5 * step.dt * variance;
    state.p(n + j, j) += 0.5 * step.dt * variance;
  }
}

}  // namespace faultline
