// SPDX-License-Identifier: MIT
#pragma once

#include "lib/reproduce/filter/hypothesis.hpp"

namespace faultline {

/// What drives and brakes one joint, and the generalised torque a unit of each fault size adds to it.
struct JointLoad {
  double drive = 0.0;    ///< N m or N
  double viscous = 0.0;  ///< N m s/rad or N s/m
  double coulomb = 0.0;  ///< N m or N
  std::array<double, kMostSizes> size_torque{};
};

/// What a fault at the joint makes of its load; `sign` is the smoothed sign of the velocity `dq`. Payloads
/// and locks change the inertia instead (FaultDynamics), sensors nothing of the motion.
inline void load_joint(FaultKind kind, std::span<const double> sizes, double dq, double sign,
                       JointLoad& load) {
  switch (kind) {
    case FaultKind::none:
    case FaultKind::locked:
    case FaultKind::sensor_bias:
    case FaultKind::stuck_encoder:
    case FaultKind::sensor_drift:
    case FaultKind::payload_change:
      return;
    case FaultKind::free_swinging:
      load.drive = 0.0;
      return;
    case FaultKind::torque_loss:
      load.size_torque[0] = -load.drive;
      load.drive *= 1.0 - sizes[0];
      return;
    case FaultKind::friction_increase:
      load.viscous += sizes[0];
      load.coulomb += sizes[1];
      load.size_torque = {-dq, -sign};
      return;
    case FaultKind::torque_sensor_error:
      load.drive -= sizes[0];
      load.size_torque[0] = -1.0;
      return;
    case FaultKind::collision:
    case FaultKind::unknown:
      load.drive += sizes[0];
      load.size_torque[0] = 1.0;
      return;
  }
}

/// Share of the drive's torque that reaches a joint with the fault.
inline double driven_share(FaultKind kind, std::span<const double> sizes) {
  if (kind == FaultKind::free_swinging) return 0.0;
  return kind == FaultKind::torque_loss ? 1.0 - sizes[0] : 1.0;
}

/// How a unit of the fault's size falsifies what a joint's sensor reads.
struct SensorError {
  int size_index = -1;  ///< in the state; -1 for none
  double on_q = 0.0;    ///< reading = truth + on_q * size
  double on_dq = 0.0;
};

/// The sensor of the hypothesis's joint, `age_s` after the onset; its size stands at `size_index` of the
/// state. A stuck sensor is not in error: it says nothing (Bank).
inline SensorError sensor_error(const Hypothesis& hypothesis, int size_index, double age_s) {
  constexpr double kLeastAge_s = 1e-9;  // an observation has to depend on the size at all
  switch (hypothesis.label.kind) {
    case FaultKind::sensor_bias:
      return {size_index, 1.0, 0.0};
    case FaultKind::sensor_drift:
      return {size_index, std::max(age_s, kLeastAge_s),
              hypothesis.form == HypothesisForm::drifting_velocity ? 1.0 : 0.0};
    case FaultKind::none:
    case FaultKind::free_swinging:
    case FaultKind::locked:
    case FaultKind::torque_loss:
    case FaultKind::stuck_encoder:
    case FaultKind::friction_increase:
    case FaultKind::payload_change:
    case FaultKind::collision:
    case FaultKind::torque_sensor_error:
    case FaultKind::unknown:
      return {};
  }
  return {};
}

}  // namespace faultline
