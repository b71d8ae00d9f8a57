// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <limits>
#include <span>

#include "lib/evidence/slow_state.hpp"
#include "lib/reproduce/filter/joint_array.hpp"

namespace faultline {

/// Positions, velocities, slow states and the numbers that say how large a fault is, at most one a joint (or
/// two).
inline constexpr int kMaxStates = 3 * kMaxJoints + kMaxSlowStates;

using StateVector = std::array<double, kMaxStates>;

/// Mean and covariance of a small state: q (n), dq (n), slow states, fault sizes.
struct GaussianState {
  int size = 0;
  StateVector mean;
  std::array<double, kMaxStates * kMaxStates> covariance;  ///< row by row, `size` numbers each

  GaussianState() = default;
  GaussianState(const GaussianState& other) { *this = other; }
  GaussianState& operator=(const GaussianState& other);

  double& p(int row, int column) { return covariance[row * size + column]; }
  double p(int row, int column) const { return covariance[row * size + column]; }
};

/// q and dq of `n` joints, which begin a state vector, taken out of it and put back.
inline MotionState motion_of(const StateVector& vector, int n) {
  MotionState motion;
  for (int j = 0; j < n; ++j) {
    motion.q[j] = vector[j];
    motion.dq[j] = vector[n + j];
  }
  return motion;
}
inline void set_motion(StateVector& vector, const MotionState& motion, int n) {
  for (int j = 0; j < n; ++j) {
    vector[j] = motion.q[j];
    vector[n + j] = motion.dq[j];
  }
}

/// A state of `size` numbers with the mean and covariance of `state` in front and zeros behind.
GaussianState extended(const GaussianState& state, int size);

/// What one measured number said.
struct ScalarUpdate {
  double innovation = 0.0;
  double variance = 0.0;  ///< of the innovation
  double chi_square() const { return innovation * innovation / variance; }
};

/// Kalman update by the measurement z = mean[index] + factor * mean[other] + noise; `other` < 0 for none. An
/// innovation of more than `tail` standard deviations is taken for one of that many of a noisier measurement.
ScalarUpdate observe(GaussianState& state, int index, int other, double factor, double z,
                     double noise_variance, double tail = std::numeric_limits<double>::infinity());

/// covariance = A covariance A^T, where A is `moving` rows of `size` numbers and below them the identity: the
/// numbers after the first `moving` stay what they are.
void propagate_covariance(GaussianState& state, std::span<const double> rows, int moving);
/// The first `moving` numbers lie anywhere between their means and those of `other`, uniformly.
void blend_with(GaussianState& state, const StateVector& other, int moving);
/// Number `index` of the state keeps this share of itself.
void relax(GaussianState& state, int index, double kept);

}  // namespace faultline
