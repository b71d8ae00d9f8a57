// SPDX-License-Identifier: MIT
#pragma once

#include "lib/reproduce/filter/sized_dynamics.hpp"

namespace faultline {

/// The equations of motion under a hypothesis, or of the healthy robot.
class FaultDynamics {
 public:
  explicit FaultDynamics(const MotionModel& model);

  int joints() const { return load_.model.joints(); }
  /// kg at the tip, less than 0: less counts as this.
  double least_payload() const { return load_.least_payload; }
  /// For many evaluations at the same sizes and slow states, which `fault` keeps alive.
  SizedDynamics at(const SizedFault& fault) const { return {load_, fault}; }
  /// Accelerations under a drive torque (N m or N).
  Acceleration evaluate(const MotionState& state, const JointArray& torque,
                        const SizedFault& fault = {}) const {
    return at(fault).evaluate(state, torque, true);
  }
  Acceleration integrate(MotionState& state, const JointArray& torque, double dt,
                         const SizedFault& fault = {}) const {
    return at(fault).integrate(state, torque, dt);
  }
  /// Change of velocity when joint j is stopped at once by a torque on that joint alone.
  JointArray stopping_impulse(const MotionState& at, int j) const;

 private:
  RobotLoad load_;
};

}  // namespace faultline
