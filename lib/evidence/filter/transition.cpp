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

/// Generalised torque that a unit of the slow state adds, and the joints where it may not be 0.
struct UnitTorque {
  std::array<double, kMaxJoints> torque;
  int first = 0, last = 0;
};

UnitTorque at_joint(int joint, double torque) {
  UnitTorque unit;
  unit.first = unit.last = joint;
  unit.torque[joint] = torque;
  return unit;
}

UnitTorque unit_torque(const SlowState& slow, const Acceleration& at, int n) {
  switch (slow.kind) {
    case SlowKind::friction:
      return at_joint(slow.joint, at.friction_torque[slow.joint]);
    case SlowKind::torque_gain:
      return at_joint(slow.joint, at.gain_torque[slow.joint]);
    case SlowKind::torque_offset:
    case SlowKind::coloured_torque:
      break;
    case SlowKind::tip_mass:
      return {at.tip_torque, 0, n - 1};
  }
  return at_joint(slow.joint, 1.0);
}

UnitTorque unit_torque(const Hypothesis& hypothesis, int s, const Acceleration& at, int n) {
  if (is_everywhere(hypothesis)) return at_joint(s, 1.0);
  if (hypothesis.label.kind == FaultKind::payload_change) return {at.tip_torque, 0, n - 1};
  const int joint = hypothesis.joint_index();
  return at_joint(joint, at.size_torque[s][joint]);
}

/// A column that is another one, further to the left, times a factor; column -1 for one of its own.
struct Likeness {
  int column = -1;
  double factor = 1.0;
};

/// Torques on one joint move it alike: the first of them that is in the state stands for all.
Likeness likeness(int column, const MotionModel& model, const Acceleration& at) {
  const int first = 2 * model.joints(), s = column - first;
  if (s < 0 || column >= model.healthy_states() || model.slow[s].kind == SlowKind::tip_mass) return {};
  for (int other = 0; other < s; ++other) {
    if (model.slow[other].kind != SlowKind::torque_offset || model.slow[other].joint != model.slow[s].joint)
      continue;
    return {first + other, unit_torque(model.slow[s], at, model.joints()).torque[model.slow[s].joint]};
  }
  return {};
}

}  // namespace

SizedFault circumstances(const StateVector& vector, const MotionModel& model, const Hypothesis* hypothesis) {
  const std::span<const double> all(vector);
  const std::size_t slow = model.slow.size(), first = 2 * static_cast<std::size_t>(model.joints());
  const std::size_t sizes = hypothesis ? static_cast<std::size_t>(hypothesis->sizes) : 0;
  return {hypothesis, all.subspan(first + slow, sizes), all.subspan(first, slow)};
}

MotionRows analytic_transition(const GaussianState& state, const Acceleration& at, const MotionModel& model,
                               double dt, const Hypothesis* hypothesis) {
  MotionRows a;
  const int n = model.joints(), size = state.size, first_size = model.healthy_states();
  const int columns = hypothesis ? size : first_size;  // sizes of a sensor's fault move nothing
  std::fill_n(a.begin(), 2 * n * size, 0.0);
  const JointSquare v = velocity_transition(at, n, dt);
  for (int i = 0; i < n; ++i) {
    a[i * size + i] = 1.0;
    a[i * size + n + i] = dt;
    for (int j = 0; j < n; ++j) a[(n + i) * size + n + j] = v[i * n + j];
  }
  for (int column = 2 * n; column < columns; ++column) {
    const UnitTorque unit = column < first_size ? unit_torque(model.slow[column - 2 * n], at, n)
                                                : unit_torque(*hypothesis, column - first_size, at, n);
    for (int i = 0; i < n; ++i) {
      double slope = 0.0;
      for (int j = unit.first; j <= unit.last; ++j) slope += at.inverse_inertia[i * n + j] * unit.torque[j];
      a[(n + i) * size + column] = dt * slope;
      a[i * size + column] = 0.5 * dt * dt * slope;
    }
  }
  return a;
}

MotionRows numeric_transition(const StateVector& before, int size, const MotionModel& model,
                              const FaultDynamics& dynamics, const JointArray& torque, double dt,
                              const Hypothesis* hypothesis) {
  MotionRows a;
  const int n = model.joints();
  auto integrate = [&](StateVector& x) {
    MotionState motion = motion_of(x, n);
    dynamics.integrate_coarsely(motion, torque, dt, circumstances(x, model, hypothesis));
    set_motion(x, motion, n);
  };
  StateVector base;
  std::copy_n(before.begin(), size, base.begin());
  integrate(base);
  const Acceleration at =
      dynamics.evaluate(motion_of(before, n), torque, circumstances(before, model, hypothesis));
  for (int column = 0; column < size; ++column) {
    const Likeness like = likeness(column, model, at);
    if (like.column >= 0) {
      for (int row = 0; row < 2 * n; ++row)
        a[row * size + column] = like.factor * a[row * size + like.column];
      continue;
    }
    StateVector moved;
    std::copy_n(before.begin(), size, moved.begin());
    const double delta = kDifference * std::max(1.0, std::abs(moved[column]));
    moved[column] += delta;
    integrate(moved);
    for (int row = 0; row < 2 * n; ++row) a[row * size + column] = (moved[row] - base[row]) / delta;
  }
  return a;
}

}  // namespace faultline
