// SPDX-License-Identifier: MIT
#include "lib/reproduce/filter/transition.hpp"

#include <algorithm>
#include <cmath>

#include "lib/reproduce/filter/small_inverse.hpp"

namespace faultline {
namespace {

constexpr double kSeriesSuffices = 0.01;  // of dt M^-1 D: two terms are then good to 1e-4
constexpr double kCoarseSubstep_s = 0.04;
constexpr double kDifference = 1e-6;  // of a state, or of 1 in its unit: between rounding and curvature

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

/// The acceleration that a unit of a slow state or of a fault's size adds.
JointArray unit_acceleration(int column, const MotionModel& model, const Acceleration& at,
                             const Hypothesis* hypothesis) {
  const int n = model.joints(), first_size = model.healthy_states();
  const UnitTorque unit = column < first_size ? unit_torque(model.slow[column - 2 * n], at, n)
                                              : unit_torque(*hypothesis, column - first_size, at, n);
  JointArray slope;
  for (int i = 0; i < n; ++i) {
    slope[i] = 0.0;
    for (int j = unit.first; j <= unit.last; ++j) slope[i] += at.inverse_inertia[i * n + j] * unit.torque[j];
  }
  return slope;
}

/// How the acceleration changes with position and velocity, by differences.
struct Slopes {
  JointSquare by_position, by_velocity;
};

Slopes slopes_at(const MotionState& state, const Acceleration& at, const SizedDynamics& dynamics,
                 const JointArray& torque, int n) {
  Slopes slopes;
  for (int column = 0; column < 2 * n; ++column) {
    const int joint = column % n;
    MotionState moved = state;
    double& number = column < n ? moved.q[joint] : moved.dq[joint];
    const double delta = kDifference * std::max(1.0, std::abs(number));
    number += delta;
    const Acceleration there = dynamics.evaluate(moved, torque, false);
    JointSquare& out = column < n ? slopes.by_position : slopes.by_velocity;
    for (int i = 0; i < n; ++i) out[i * n + joint] = (there.value[i] - at.value[i]) / delta;
  }
  return slopes;
}

/// (1 - h/2 Kv - h^2/4 Kq)^-1, Kq and Kv the slopes by position and velocity.
JointSquare trapezoidal_inverse(const Slopes& slopes, int n, double h) {
  JointSquare system, inverse;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      system[i * n + j] = (i == j ? 1.0 : 0.0) - 0.5 * h * slopes.by_velocity[i * n + j] -
                          0.5 * h * 0.5 * h * slopes.by_position[i * n + j];
  invert_general(system, n, inverse);
  return inverse;
}

/// Takes the rows of q and dq through a substep of length h.
void advance_rows(MotionRows& a, int size, const Slopes& slopes, const MotionModel& model,
                  const Acceleration& at, const Hypothesis* hypothesis, double h) {
  const int n = model.joints(), columns = hypothesis ? size : model.healthy_states();
  const JointSquare inverse = trapezoidal_inverse(slopes, n, h);
  JointSquare on_q, on_dq;  // h Kq and 1 + h/2 Kv + h^2/4 Kq
  for (int i = 0; i < n * n; ++i) {
    on_q[i] = h * slopes.by_position[i];
    on_dq[i] = 0.5 * h * slopes.by_velocity[i] + 0.5 * 0.5 * h * on_q[i];
  }
  for (int i = 0; i < n; ++i) on_dq[i * n + i] += 1.0;
  for (int column = 0; column < columns; ++column) {
    JointArray right{};
    if (column >= 2 * n) {
      right = unit_acceleration(column, model, at, hypothesis);
      for (int i = 0; i < n; ++i) right[i] *= h;
    }
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        right[i] += on_q[i * n + j] * a[j * size + column] + on_dq[i * n + j] * a[(n + j) * size + column];
    for (int i = 0; i < n; ++i) {
      double velocity = 0.0;
      for (int j = 0; j < n; ++j) velocity += inverse[i * n + j] * right[j];
      double& before = a[(n + i) * size + column];
      a[i * size + column] += 0.5 * h * (before + velocity);
      before = velocity;
    }
  }
}

}  // namespace

SizedFault circumstances(const StateVector& vector, const MotionModel& model, const Hypothesis* hypothesis,
                         std::span<const double> drive_level) {
  const std::span<const double> all(vector);
  const std::size_t slow = model.slow.size(), first = 2 * static_cast<std::size_t>(model.joints());
  const std::size_t sizes = hypothesis ? static_cast<std::size_t>(hypothesis->sizes) : 0;
  return {hypothesis, all.subspan(first + slow, sizes), all.subspan(first, slow), drive_level};
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
    const JointArray slope = unit_acceleration(column, model, at, hypothesis);
    for (int i = 0; i < n; ++i) {
      a[(n + i) * size + column] = dt * slope[i];
      a[i * size + column] = 0.5 * dt * dt * slope[i];
    }
  }
  return a;
}

MotionRows stepwise_transition(const StateVector& before, int size, const MotionModel& model,
                               const FaultDynamics& dynamics, const JointArray& torque,
                               std::span<const double> drive_level, double dt, const Hypothesis* hypothesis) {
  MotionRows a;
  const int n = model.joints();
  std::fill_n(a.begin(), 2 * n * size, 0.0);
  for (int i = 0; i < 2 * n; ++i) a[i * size + i] = 1.0;
  const SizedDynamics sized = dynamics.at(circumstances(before, model, hypothesis, drive_level));
  MotionState state = motion_of(before, n);
  Acceleration start = sized.evaluate(state, torque, false);
  const int steps = SizedDynamics::substeps(start, dt, kCoarseSubstep_s);
  const double h = dt / steps;
  for (int step = 0; step < steps; ++step) {
    if (step > 0) start = sized.evaluate(state, torque, false);
    MotionState middle = state;
    sized.advance(middle, start, 0.5 * h);
    const Acceleration at = sized.evaluate(middle, torque, true);
    advance_rows(a, size, slopes_at(middle, at, sized, torque, n), model, at, hypothesis, h);
    sized.advance(state, SizedDynamics::is_stiff(start, h) ? start : at, h);
  }
  return a;
}

}  // namespace faultline
