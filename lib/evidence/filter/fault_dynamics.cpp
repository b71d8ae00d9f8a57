// SPDX-License-Identifier: MIT
#include "lib/evidence/filter/fault_dynamics.hpp"

#include <algorithm>
#include <cmath>

#include "lib/evidence/filter/fault_load.hpp"
#include "lib/evidence/filter/small_inverse.hpp"
#include "lib/robot/dynamics.hpp"

namespace faultline {
namespace {

using Map = Eigen::Map<const Eigen::VectorXd>;

constexpr double kSaturated = 20.0;      // tanh is 1 to the last bit from 19.1
constexpr double kLeastFriction = 0.05;  // of the identified: friction never drives

/// tanh, at once where it is 1 to the last bit: a joint that moves.
double saturating_tanh(double x) { return std::abs(x) > kSaturated ? std::copysign(1.0, x) : std::tanh(x); }

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

FaultKind kind_of(const SizedFault& fault) {
  return fault.hypothesis ? fault.hypothesis->label.kind : FaultKind::none;
}

}  // namespace

/// What the slow states make of each joint's load.
struct FaultDynamics::SlowLoad {
  JointArray friction_scale, gain;
  JointArray torque;  ///< beside the drive's, N m or N
  double tip_mass = 0.0;
  bool tip_is_free = false;  ///< it is in the state
};

struct FaultDynamics::RigidBody {
  JointMatrix<double> inertia;
  JointVector<double> bias;             ///< h + G
  JointMatrix<double> payload_inertia;  ///< what a kilogram at the tip adds, where the tip is free
  JointVector<double> payload_bias;
  bool tip_is_free = false;
};

FaultDynamics::FaultDynamics(const MotionModel& model)
    : model_(model),
      healthy_(model.chain),
      unit_payload_(with_unit_payload(model.chain)),
      joints_(model.joints()) {}

FaultDynamics::SlowLoad FaultDynamics::slow_load(const SizedFault& fault) const {
  SlowLoad load;
  load.friction_scale.fill(1.0);
  load.gain.fill(1.0);
  load.torque.fill(0.0);
  for (std::size_t s = 0; s < fault.slow.size(); ++s) {
    const SlowState& state = model_.slow[s];
    switch (state.kind) {
      case SlowKind::friction:
        load.friction_scale[state.joint] = std::max(1.0 + fault.slow[s], kLeastFriction);
        break;
      case SlowKind::torque_gain:
        load.gain[state.joint] += fault.slow[s];
        break;
      case SlowKind::torque_offset:
      case SlowKind::coloured_torque:
        load.torque[state.joint] += fault.slow[s];
        break;
      case SlowKind::tip_mass:
        load.tip_mass = fault.slow[s];
        load.tip_is_free = true;
        break;
    }
  }
  return load;
}

FaultDynamics::RigidBody FaultDynamics::rigid_body(const MotionState& at, const SizedFault& fault,
                                                   const SlowLoad& slow) const {
  const JointVector<double> q = Map(at.q.data(), joints_), dq = Map(at.dq.data(), joints_);
  RigidBody body;
  body.inertia.resize(joints_, joints_);
  body.bias.resize(joints_);
  healthy_.inertia_and_bias(q, dq, body.inertia, body.bias);
  const bool payload = kind_of(fault) == FaultKind::payload_change;
  body.tip_is_free = payload || slow.tip_is_free;
  if (!body.tip_is_free) return body;
  const double mass = slow.tip_mass + (payload ? fault.sizes[0] : 0.0);
  body.payload_inertia.resize(joints_, joints_);
  body.payload_bias.resize(joints_);
  unit_payload_.inertia_and_bias(q, dq, body.payload_inertia, body.payload_bias);
  body.payload_bias -= body.bias;
  body.payload_inertia -= body.inertia;
  body.bias += mass * body.payload_bias;
  body.inertia += mass * body.payload_inertia;
  return body;
}

/// The torque that accelerates each joint, with what `out` tells of friction, fault sizes and slow states.
JointArray FaultDynamics::net_torque(const MotionState& at, const JointArray& torque, const SizedFault& fault,
                                     const SlowLoad& slow, const RigidBody& body, Acceleration& out) const {
  const int n = joints_;
  const FaultKind kind = kind_of(fault);
  const int joint = fault.hypothesis ? fault.hypothesis->joint_index() : -1;
  const bool everywhere = fault.hypothesis && is_everywhere(*fault.hypothesis);
  JointArray net;
  for (int j = 0; j < n; ++j) {
    const Friction<double>& f = model_.chain.friction[j];
    const bool rubs = f.coulomb != 0.0 || (j == joint && kind == FaultKind::friction_increase);
    const double sign = rubs ? saturating_tanh(at.dq[j] / f.width) : 0.0;
    const double sharpness = rubs ? (1.0 - sign * sign) / f.width : 0.0;
    const double scale = slow.friction_scale[j];
    JointLoad load{slow.gain[j] * torque[j], scale * f.viscous, scale * f.coulomb, {}};
    if (j == joint) load_joint(kind, fault.sizes, at.dq[j], sign, load);
    if (everywhere) load.drive += fault.sizes[j];
    for (int s = 0; s < kMostSizes; ++s) out.size_torque[s][j] = load.size_torque[s];
    out.friction_torque[j] = -f.viscous * at.dq[j] - f.coulomb * sign;
    out.gain_torque[j] = torque[j] * (j == joint ? driven_share(kind, fault.sizes) : 1.0);
    out.friction_slope[j] = load.viscous + load.coulomb * sharpness;
    out.stiffness =
        std::max(out.stiffness, out.inverse_inertia[j * n + j] * (load.viscous + load.coulomb / f.width));
    net[j] =
        load.drive - body.bias[j] - load.viscous * at.dq[j] - load.coulomb * sign - f.offset + slow.torque[j];
  }
  return net;
}

Acceleration FaultDynamics::evaluate(const MotionState& at, const JointArray& torque,
                                     const SizedFault& fault) const {
  const int n = joints_;
  const FaultKind kind = kind_of(fault);
  const SlowLoad slow = slow_load(fault);
  const RigidBody body = rigid_body(at, fault, slow);
  Acceleration out;
  invert_inertia(body.inertia, kind == FaultKind::locked ? fault.hypothesis->joint_index() : -1,
                 out.inverse_inertia);
  const JointArray net = net_torque(at, torque, fault, slow, body, out);
  for (int i = 0; i < n; ++i) {
    double sum = 0.0;
    for (int j = 0; j < n; ++j) sum += out.inverse_inertia[i * n + j] * net[j];
    out.value[i] = sum;
  }
  if (!body.tip_is_free) return out;
  for (int i = 0; i < n; ++i) {
    double sum = body.payload_bias[i];
    for (int j = 0; j < n; ++j) sum += body.payload_inertia(i, j) * out.value[j];
    out.tip_torque[i] = -sum;
  }
  if (kind == FaultKind::payload_change) out.size_torque[0] = out.tip_torque;
  return out;
}

JointArray FaultDynamics::stopping_impulse(const MotionState& at, int j) const {
  const JointVector<double> q = Map(at.q.data(), joints_);
  JointSquare inverse;
  invert_inertia(inertia_matrix(model_.chain, q), -1, inverse);
  JointArray change{};
  const double impulse = -at.dq[j] / inverse[j * joints_ + j];
  for (int i = 0; i < joints_; ++i) change[i] = inverse[i * joints_ + j] * impulse;
  return change;
}

}  // namespace faultline
