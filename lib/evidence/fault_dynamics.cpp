// SPDX-License-Identifier: MIT
#include "lib/evidence/fault_dynamics.hpp"

#include <algorithm>
#include <cmath>

#include "lib/evidence/fault_load.hpp"
#include "lib/evidence/small_inverse.hpp"
#include "lib/robot/dynamics.hpp"

namespace faultline {
namespace {

constexpr int kMostSubsteps = 40;
constexpr double kCoarseSubstep_s = 0.025;
constexpr double kStiff = 1.0;  // friction rate times step from which explicit rules need shorter steps

using Map = Eigen::Map<const Eigen::VectorXd>;

/// tanh, at once where it is 1 to the last bit: a joint that moves.
double saturating_tanh(double x) { return std::abs(x) > 20.0 ? std::copysign(1.0, x) : std::tanh(x); }

/// One more kilogram on the tip: at the last link's origin for a prismatic last axis, at its end otherwise.
Chain<double> with_unit_payload(const Chain<double>& chain) {
  Chain<double> loaded = chain;
  const int last = chain.joints() - 1;
  LinkInertia<double>& link = loaded.links[last];
  const JointGeometry& joint = chain.geometry[last];
  const bool has_reach = joint.kind == AxisKind::revolute && joint.direction.squaredNorm() > 0.0;
  const Eigen::Vector3d at =
      has_reach ? Eigen::Vector3d(chain.length[last] * joint.direction) : Eigen::Vector3d::Zero();
  const LinkInertia<double> kilogram = general_body(1.0, at, Eigen::Matrix3d::Zero());
  link.mass += kilogram.mass;
  link.first_moment += kilogram.first_moment;
  link.inertia += kilogram.inertia;
  return loaded;
}

}  // namespace

FaultDynamics::FaultDynamics(const MotionModel& model)
    : model_(model),
      healthy_(model.chain),
      unit_payload_(with_unit_payload(model.chain)),
      joints_(model.joints()) {}

Acceleration FaultDynamics::evaluate(const double* q_in, const double* dq_in, const double* torque,
                                     const Hypothesis* hypothesis, const double* sizes) const {
  const int n = joints_;
  const JointVector<double> q = Map(q_in, n), dq = Map(dq_in, n);
  JointVector<double> bias(n);
  JointMatrix<double> inertia(n, n);
  healthy_.inertia_and_bias(q, dq, inertia, bias);
  const FaultKind kind = hypothesis ? hypothesis->label.kind : FaultKind::none;
  const int joint = hypothesis ? hypothesis->joint_index() : -1;
  const bool everywhere = hypothesis && is_everywhere(*hypothesis);
  Acceleration out;
  JointVector<double> payload_bias;
  JointMatrix<double> payload_inertia;
  if (kind == FaultKind::payload_change) {
    payload_bias.resize(n);
    payload_inertia.resize(n, n);
    unit_payload_.inertia_and_bias(q, dq, payload_inertia, payload_bias);
    payload_bias -= bias;
    payload_inertia -= inertia;
    bias += sizes[0] * payload_bias;
    inertia += sizes[0] * payload_inertia;
  }
  invert_inertia(inertia, kind == FaultKind::locked ? joint : -1, out.inverse_inertia);

  JointArray net;
  for (int j = 0; j < n; ++j) {
    const Friction<double>& f = model_.chain.friction[j];
    const bool rubs = f.coulomb != 0.0 || (j == joint && kind == FaultKind::friction_increase);
    const double sign = rubs ? saturating_tanh(dq[j] / f.width) : 0.0;
    const double sharpness = rubs ? (1.0 - sign * sign) / f.width : 0.0;
    JointLoad load{torque[j], f.viscous, f.coulomb, {}};
    if (j == joint) load_joint(kind, sizes, dq[j], sign, load);
    if (everywhere) load.drive += sizes[j];
    for (int s = 0; s < kMostSizes; ++s) out.size_torque[s][j] = load.size_torque[s];
    out.friction_slope[j] = load.viscous + load.coulomb * sharpness;
    out.stiffness =
        std::max(out.stiffness, out.inverse_inertia[j * n + j] * (load.viscous + load.coulomb / f.width));
    net[j] = load.drive - bias[j] - load.viscous * dq[j] - load.coulomb * sign - f.offset;
  }
  for (int i = 0; i < n; ++i) {
    double sum = 0.0;
    for (int j = 0; j < n; ++j) sum += out.inverse_inertia[i * n + j] * net[j];
    out.value[i] = sum;
  }
  if (kind == FaultKind::payload_change) {
    for (int i = 0; i < n; ++i) {
      double sum = payload_bias[i];
      for (int j = 0; j < n; ++j) sum += payload_inertia(i, j) * out.value[j];
      out.size_torque[0][i] = -sum;
    }
  }
  return out;
}

void FaultDynamics::midpoint_step(double* q, double* dq, const Acceleration& start, const double* torque,
                                  double h, const Hypothesis* hypothesis, const double* sizes,
                                  Acceleration* middle) const {
  JointArray q_mid, dq_mid;
  for (int j = 0; j < joints_; ++j) {
    dq_mid[j] = dq[j] + 0.5 * h * start.value[j];
    q_mid[j] = q[j] + 0.5 * h * dq[j];
  }
  const Acceleration at = evaluate(q_mid.data(), dq_mid.data(), torque, hypothesis, sizes);
  for (int j = 0; j < joints_; ++j) {
    q[j] += h * dq_mid[j];
    dq[j] += h * at.value[j];
  }
  if (middle) *middle = at;
}

void FaultDynamics::implicit_step(double* q, double* dq, const Acceleration& at, double h) const {
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
    q[j] += h * (dq[j] + 0.5 * change[j]);
    dq[j] += change[j];
  }
}

void FaultDynamics::runge_kutta_step(double* q, double* dq, const double* torque, double h,
                                     const Hypothesis* hypothesis, const double* sizes) const {
  static constexpr double kFraction[4] = {0.0, 0.5, 0.5, 1.0};
  static constexpr double kWeight[4] = {1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0};
  const int n = joints_;
  JointArray qs, vs, v{}, a{}, sum_v{}, sum_a{};
  for (int stage = 0; stage < 4; ++stage) {
    for (int j = 0; j < n; ++j) {
      qs[j] = q[j] + kFraction[stage] * h * v[j];
      vs[j] = dq[j] + kFraction[stage] * h * a[j];
    }
    const Acceleration at = evaluate(qs.data(), vs.data(), torque, hypothesis, sizes);
    for (int j = 0; j < n; ++j) {
      v[j] = vs[j];
      a[j] = at.value[j];
      sum_v[j] += kWeight[stage] * v[j];
      sum_a[j] += kWeight[stage] * a[j];
    }
  }
  for (int j = 0; j < n; ++j) {
    q[j] += h * sum_v[j];
    dq[j] += h * sum_a[j];
  }
}

Acceleration FaultDynamics::integrate(double* q, double* dq, const double* torque, double dt,
                                      const Hypothesis* hypothesis, const double* sizes) const {
  const Acceleration first = evaluate(q, dq, torque, hypothesis, sizes);
  const bool stiff = first.stiffness * dt > kStiff;
  if (dt <= kShortStep_s && !stiff) {
    Acceleration middle;
    midpoint_step(q, dq, first, torque, dt, hypothesis, sizes, &middle);
    return middle;
  }
  const double wanted = std::max(dt / kLongestSubstep_s, first.stiffness * dt / kStiff);
  const int steps = std::clamp(static_cast<int>(std::ceil(wanted)), 1, kMostSubsteps);
  const double h = dt / steps;
  if (first.stiffness * h <= kStiff) {
    for (int step = 0; step < steps; ++step) runge_kutta_step(q, dq, torque, h, hypothesis, sizes);
  } else {
    implicit_step(q, dq, first, h);
    for (int step = 1; step < steps; ++step)
      implicit_step(q, dq, evaluate(q, dq, torque, hypothesis, sizes), h);
  }
  return first;
}

void FaultDynamics::integrate_coarsely(double* q, double* dq, const double* torque, double dt,
                                       const Hypothesis* hypothesis, const double* sizes) const {
  Acceleration at = evaluate(q, dq, torque, hypothesis, sizes);
  const double wanted = std::max(dt / kCoarseSubstep_s, at.stiffness * dt / kStiff);
  const int steps = std::clamp(static_cast<int>(std::ceil(wanted)), 1, kMostSubsteps);
  const double h = dt / steps;
  for (int step = 0; step < steps; ++step) {
    if (step > 0) at = evaluate(q, dq, torque, hypothesis, sizes);
    if (at.stiffness * h <= kStiff)
      midpoint_step(q, dq, at, torque, h, hypothesis, sizes, nullptr);
    else
      implicit_step(q, dq, at, h);
  }
}

JointArray FaultDynamics::stopping_impulse(const double* q_in, const double* dq, int j) const {
  const JointVector<double> q = Map(q_in, joints_);
  JointSquare inverse;
  invert_inertia(inertia_matrix(model_.chain, q), -1, inverse);
  JointArray change{};
  const double impulse = -dq[j] / inverse[j * joints_ + j];
  for (int i = 0; i < joints_; ++i) change[i] = inverse[i * joints_ + j] * impulse;
  return change;
}

}  // namespace faultline
