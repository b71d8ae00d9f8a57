// SPDX-License-Identifier: MIT
#include "lib/evidence/filter/fault_dynamics.hpp"

#include "lib/evidence/filter/small_inverse.hpp"
#include "lib/robot/dynamics.hpp"

namespace faultline {
namespace {

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

RobotLoad::RobotLoad(const MotionModel& motion_model)
    : model(motion_model),
      healthy(motion_model.chain),
      unit_payload(with_unit_payload(motion_model.chain)),
      payload_bodies(healthy.planar() ? healthy.bodies_more_in(unit_payload) : FastDynamics::Bodies{}) {}

FaultDynamics::FaultDynamics(const MotionModel& model) : load_(model) {}

JointArray FaultDynamics::stopping_impulse(const MotionState& at, int j) const {
  const int n = joints();
  const JointVector<double> q = Eigen::Map<const Eigen::VectorXd>(at.q.data(), n);
  JointSquare inverse;
  invert_inertia(inertia_matrix(load_.model.chain, q), -1, inverse);
  JointArray change{};
  const double impulse = -at.dq[j] / inverse[j * n + j];
  for (int i = 0; i < n; ++i) change[i] = inverse[i * n + j] * impulse;
  return change;
}

}  // namespace faultline
