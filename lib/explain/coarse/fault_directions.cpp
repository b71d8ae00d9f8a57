// SPDX-License-Identifier: MIT
#include "lib/explain/coarse/fault_directions.hpp"

#include "lib/explain/fault_claim.hpp"
#include "lib/fault/fault_catalogue.hpp"
#include "lib/robot/payload.hpp"

namespace faultline {
namespace {

using Eigen::MatrixXd;

constexpr double kUsualOffset = 0.6;  // of the usual torque: standard deviation of a torque sensor's offset

}  // namespace

FaultDirections fault_directions(const OneStepModel& m, FaultKind kind, Joint joint) {
  const MotionLayout at = m.layout();
  const int j = joint.index();
  FaultDirections out;
  const auto make = [&](int sizes) {
    out.direction = MatrixXd::Zero(at.count(), sizes);
    out.std.resize(sizes);
  };
  if (kind == FaultKind::torque_loss || kind == FaultKind::free_swinging) {
    make(1);
    out.direction(at.gain(j), 0) = -1.0;
    out.std << 0.5;
  } else if (kind == FaultKind::friction_increase) {
    make(2);
    out.direction(at.viscous(j), 0) = out.direction(at.coulomb(j), 1) = 1.0;
    // Shares of the usual torque, at 1 rad/s or m/s and at any speed, serve robots without friction.
    out.std << 3.0 * m.theta[at.viscous(j)] + 0.05 * m.torque_rms[j],
        3.0 * m.theta[at.coulomb(j)] + 0.1 * m.torque_rms[j];
  } else if (kind == FaultKind::payload_change) {
    make(1);
    out.direction.col(0).head(at.base) = m.payload.col(j);
    out.std << 0.6 * m.carried_kg[j];
  } else if (kind == FaultKind::torque_sensor_error) {
    make(1);
    out.direction(at.force(j), 0) = -1.0;
    out.std << kUsualOffset * m.torque_rms[j];
  } else if (kind == FaultKind::collision) {
    make(at.joints);
    for (int i = 0; i < at.joints; ++i) out.direction(at.force(i), i) = 1.0;
    out.std = m.torque_rms;
  }
  return out;
}

std::vector<FaultLabel> fault_labels_of(const OneStepModel& model) {
  return fault_labels(model.joints(), payload_links(model.body.rigid().chain), model.torque_is_measured);
}

Eigen::VectorXd prior_of_sizes(const OneStepModel& model, FaultKind kind, Joint joint) {
  if (!falsifies_position(kind)) return fault_directions(model, kind, joint).std;
  const bool turns = model.body.rigid().chain.geometry[joint.index()].kind == AxisKind::revolute;
  return Eigen::VectorXd::Constant(1, turns ? 0.1 : 0.03);
}

}  // namespace faultline
