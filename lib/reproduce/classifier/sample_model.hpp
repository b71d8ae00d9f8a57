// SPDX-License-Identifier: MIT
#pragma once

#include "lib/reproduce/protocol/protocol.hpp"
#include "lib/residual/physics_step.hpp"
#include "lib/simulate/controller.hpp"

namespace faultline {

/// What the torque is taken to do between two samples.
enum class TorqueBetween {
  controlled,  ///< what the controller makes of it: constant (held), following the state at the set-point
               ///< that the first torque implies (pd), or keeping the acceleration it asks for (fast)
  linear,      ///< moves straight to the torque of the next sample
};

/// Predicts one sample of the bench robot, healthy or with a joint that swings freely: its own equations and
/// its controller's, with nothing learned.
class SampleModel {
 public:
  SampleModel(const Robot& robot, ControllerVariant controller, TorqueBetween between);

  /// The state a sample later. `output` is the class (table_1_class); `next_tau` matters for linear only.
  JointState next(const JointState& now, const JointVector& tau, const JointVector& next_tau,
                  int output) const;

  const FastDynamics& dynamics() const { return dynamics_; }

 private:
  JointVector set_point(const JointState& now, const JointVector& tau) const;

  FastDynamics dynamics_;
  ControllerVariant reading_;
  TorqueBetween between_;
  Controller controller_;
};

}  // namespace faultline
