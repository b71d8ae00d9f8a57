// SPDX-License-Identifier: MIT
#include "lib/reproduce/filter/sized_dynamics.hpp"

#include <algorithm>
#include <cmath>

#include "lib/core/elementary/elementary.hpp"
#include "lib/reproduce/filter/fault_load.hpp"
#include "lib/reproduce/filter/small_inverse.hpp"
#include "lib/robot/extra_torque.hpp"

namespace faultline {
namespace {

using Map = Eigen::Map<const Eigen::VectorXd>;

constexpr double kSaturated = 20.0;      // tanh is 1 to the last bit from 19.1
constexpr double kLeastFriction = 0.05;  // of the identified: friction never drives

/// tanh, at once where it is 1 to the last bit: a joint that moves.
double saturating_tanh(double x) {
  return std::abs(x) > kSaturated ? std::copysign(1.0, x) : 1.0 - 2.0 / (elementary::exp(2.0 * x) + 1.0);
}

/// Friction beside the viscous and Coulomb kind that fault and slow states scale alike, and its slope.
struct Shape {
  double torque = 0.0, slope = 0.0;
};

Shape shape_of(const Friction<double>& friction, double dq) {
  Shape shape;
  if (friction.bend != 0.0) {
    const double bent = saturating_tanh(dq / friction.bend_width);
    shape.torque += friction.bend * bent;
    shape.slope += friction.bend * (1.0 - bent * bent) / friction.bend_width;
  }
  if (friction.skew != 0.0) {
    shape.torque += friction.skew * std::abs(dq);
    shape.slope += std::copysign(friction.skew, dq);
  }
  return shape;
}

}  // namespace

struct SizedDynamics::RigidBody {
  JointVector<double> q, dq;
  JointMatrix<double> inertia;
  JointVector<double> bias;             ///< h + G
  JointMatrix<double> payload_inertia;  ///< what a kilogram at the tip adds, where it had to be worked out
  JointVector<double> payload_bias;
};

SizedDynamics::SizedDynamics(const RobotLoad& load, const SizedFault& fault)
    : load_(load),
      sizes_(fault.sizes),
      drive_level_(fault.drive_level),
      kind_(fault.hypothesis ? fault.hypothesis->label.kind : FaultKind::none),
      joints_(load.model.joints()) {
  if (fault.hypothesis) {
    joint_ = fault.hypothesis->joint_index();
    everywhere_ = is_everywhere(*fault.hypothesis);
  }
  take_slow_states(fault);
  if (kind_ == FaultKind::payload_change) {
    tip_mass_ += sizes_[0];
    tip_is_free_ = true;
  }
  tip_mass_ = std::max(tip_mass_, load.least_payload);
  if (load.healthy.planar()) load.healthy.add_bodies(load.payload_bodies, tip_mass_, bodies_);
}

void SizedDynamics::take_slow_states(const SizedFault& fault) {
  friction_scale_.fill(1.0);
  gain_.fill(1.0);
  slow_torque_.fill(0.0);
  coloured_.fill(0.0);
  for (std::size_t s = 0; s < fault.slow.size(); ++s) {
    const SlowState& state = load_.model.slow[s];
    switch (state.kind) {
      case SlowKind::friction:
        friction_scale_[state.joint] = std::max(1.0 + fault.slow[s], kLeastFriction);
        break;
      case SlowKind::torque_gain:
        gain_[state.joint] += fault.slow[s];
        break;
      case SlowKind::coloured_torque:
        coloured_[state.joint] += fault.slow[s];
        [[fallthrough]];
      case SlowKind::torque_offset:
        slow_torque_[state.joint] += fault.slow[s];
        break;
      case SlowKind::tip_mass:
        tip_mass_ = fault.slow[s];
        tip_is_free_ = true;
        break;
    }
  }
}

void SizedDynamics::rigid_body(const MotionState& at, RigidBody& body) const {
  body.q = Map(at.q.data(), joints_);
  body.dq = Map(at.dq.data(), joints_);
  if (load_.healthy.planar())
    return load_.healthy.inertia_and_bias(body.q, body.dq, bodies_, body.inertia, body.bias);
  load_.healthy.inertia_and_bias(body.q, body.dq, body.inertia, body.bias);
  if (!tip_is_free_) return;
  load_.unit_payload.inertia_and_bias(body.q, body.dq, body.payload_inertia, body.payload_bias);
  body.payload_bias -= body.bias;
  body.payload_inertia -= body.inertia;
  body.bias += tip_mass_ * body.payload_bias;
  body.inertia += tip_mass_ * body.payload_inertia;
}

/// Takes ripples and friction that joints share out of the torque that accelerates them.
void SizedDynamics::take_extra_torque(const RigidBody& body, NetTorque& net, Acceleration& out) const {
  const Chain<double>& chain = load_.model.chain;
  if (chain.ripples.empty() && chain.shared_drives.empty()) return;
  JointVector<double> extra = JointVector<double>::Zero(joints_);
  add_extra_torque(chain, body.q, body.dq, extra);
  for (int j = 0; j < joints_; ++j) net.value[j] -= extra[j];
  for (const SharedDrive& f : chain.shared_drives) {
    const double sign = saturating_tanh(f.speed(body.dq.data()) / f.width);
    for (int j = 0; j < joints_; ++j) {
      const double share = f.along[j] * f.along[j];
      out.friction_slope[j] += share * (f.viscous + f.coulomb * (1.0 - sign * sign) / f.width);
      net.steepest[j] += share * (f.viscous + f.coulomb / f.width);
    }
  }
}

/// Takes what gears lose of the torque they carry, before gravity and Coriolis torque are taken from it.
void SizedDynamics::lose_to_load(const MotionState& at, NetTorque& net, Acceleration& out) const {
  for (int j = 0; j < joints_; ++j) {
    const Friction<double>& f = load_.model.chain.friction[j];
    if (f.load == 0.0) continue;
    const double sign = saturating_tanh(at.dq[j] / f.width), share = friction_scale_[j] * f.load;
    net.value[j] = carried_torque(share * sign, net.value[j]);
    const double carried = std::abs(net.value[j]), steepest = share * carried / f.width;
    out.friction_torque[j] -= f.load * carried * sign;
    out.friction_slope[j] += steepest * (1.0 - sign * sign);
    net.steepest[j] += steepest;
  }
}

/// The torque that accelerates each joint, with what `out` tells of friction, fault sizes and slow states.
JointArray SizedDynamics::net_torque(const MotionState& at, const JointArray& torque, const RigidBody& body,
                                     Acceleration& out) const {
  const int n = joints_;
  NetTorque net;
  for (int j = 0; j < n; ++j) {
    const Friction<double>& f = load_.model.chain.friction[j];
    const bool rubs = f.coulomb != 0.0 || (j == joint_ && kind_ == FaultKind::friction_increase);
    const double sign = rubs ? saturating_tanh(at.dq[j] / f.width) : 0.0;
    const double sharpness = rubs ? (1.0 - sign * sign) / f.width : 0.0;
    const double scale = friction_scale_[j];
    const Shape shape = shape_of(f, at.dq[j]);
    JointLoad load{gain_[j] * torque[j], scale * f.viscous, scale * f.coulomb, {}};
    if (j == joint_) load_joint(kind_, sizes_, at.dq[j], sign, load);
    if (everywhere_) load.drive += sizes_[j];
    for (int s = 0; s < kMostSizes; ++s) out.size_torque[s][j] = load.size_torque[s];
    out.friction_torque[j] = -f.viscous * at.dq[j] - f.coulomb * sign - shape.torque;
    out.gain_torque[j] = (drive_level_.empty() ? torque[j] : drive_level_[j]) *
                         (j == joint_ ? driven_share(kind_, sizes_) : 1.0);
    out.friction_slope[j] = load.viscous + load.coulomb * sharpness + scale * shape.slope;
    net.steepest[j] = load.viscous + load.coulomb / f.width;
    net.value[j] = load.drive - load.viscous * at.dq[j] - load.coulomb * sign - scale * shape.torque -
                   f.offset + slow_torque_[j];
  }
  take_extra_torque(body, net, out);
  lose_to_load(at, net, out);
  for (int j = 0; j < n; ++j) {
    out.stiffness = std::max(out.stiffness, out.inverse_inertia[j * n + j] * net.steepest[j]);
    net.value[j] -= body.bias[j];
  }
  return net.value;
}

/// The acceleration without what the drive's quick part and the coloured torques do.
JointArray SizedDynamics::telling_acceleration(const JointArray& torque, const Acceleration& at) const {
  JointArray telling = at.value;
  if (drive_level_.empty()) return telling;
  for (int j = 0; j < joints_; ++j) {
    const double quick = gain_[j] * (torque[j] - drive_level_[j]) + coloured_[j];
    for (int i = 0; i < joints_; ++i) telling[i] -= at.inverse_inertia[i * joints_ + j] * quick;
  }
  return telling;
}

/// What a kilogram at the tip, accelerated as tells of it, asks of every joint.
void SizedDynamics::tip_torque(const RigidBody& body, const JointArray& torque, Acceleration& out) const {
  JointMatrix<double> inertia = body.payload_inertia;
  JointVector<double> bias = body.payload_bias;
  if (load_.healthy.planar())
    load_.healthy.inertia_and_bias(body.q, body.dq, load_.payload_bodies, inertia, bias);
  const JointArray acceleration = telling_acceleration(torque, out);
  for (int i = 0; i < joints_; ++i) {
    double sum = bias[i];
    for (int j = 0; j < joints_; ++j) sum += inertia(i, j) * acceleration[j];
    out.tip_torque[i] = -sum;
  }
  if (kind_ == FaultKind::payload_change) out.size_torque[0] = out.tip_torque;
}

Acceleration SizedDynamics::evaluate(const MotionState& at, const JointArray& torque, bool with_tip) const {
  const int n = joints_;
  RigidBody body;
  rigid_body(at, body);
  Acceleration out;
  invert_inertia(body.inertia, kind_ == FaultKind::locked ? joint_ : -1, out.inverse_inertia);
  const JointArray net = net_torque(at, torque, body, out);
  for (int i = 0; i < n; ++i) {
    double sum = 0.0;
    for (int j = 0; j < n; ++j) sum += out.inverse_inertia[i * n + j] * net[j];
    out.value[i] = sum;
  }
  if (with_tip && tip_is_free_) tip_torque(body, torque, out);
  return out;
}

}  // namespace faultline
