// SPDX-License-Identifier: MIT
#include "lib/evidence/filter/transition.hpp"

#include <algorithm>
#include <cmath>

#include "lib/evidence/filter/small_inverse.hpp"

namespace faultline {
namespace {

constexpr double kSeriesSuffices = 0.01;  // of dt M^-1 D: two terms are then good to 1e-4
constexpr double kDifference = 1e-6;      // of a state, or of 1 in its unit: between rounding and curvature

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
  if (largest < kSeriesSuffices) {
    for (int i = 0; i < n * n; ++i) v[i] -= x[i];
    return v;
  }
  for (int i = 0; i < n; ++i) x[i * n + i] += 1.0;
  invert_general(x, n, v);
  return v;
}

}  // namespace

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

Transition numeric_transition(const GaussianState& before, const MotionModel& model,
                              const FaultDynamics& dynamics, const JointArray& torque, double dt,
                              const Hypothesis* hypothesis) {
  Transition a;
  const int n = model.joints(), size = before.size;
  std::fill_n(a.begin(), size * size, 0.0);
  auto integrate = [&](StateVector& x) {
    MotionState motion = motion_of(x, n);
    dynamics.integrate_coarsely(motion, torque, dt, {hypothesis, sizes_of(x, n, size)});
    set_motion(x, motion, n);
  };
  StateVector base = before.mean;
  integrate(base);
  for (int column = 0; column < size; ++column) {
    StateVector moved = before.mean;
    const double delta = kDifference * std::max(1.0, std::abs(moved[column]));
    moved[column] += delta;
    integrate(moved);
    for (int row = 0; row < 2 * n; ++row) a[row * size + column] = (moved[row] - base[row]) / delta;
    if (column >= 2 * n) a[column * size + column] = 1.0;
  }
  return a;
}

}  // namespace faultline
