// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "lib/robot/fast_dynamics.hpp"
#include "lib/robot/robot.hpp"
#include "lib/simulate/motion.hpp"

namespace faultline {

enum class ControllerKind {
  computed_torque,  ///< tau = M (ddq_ref + kd e' + kp e) + h + G [+ F(dq_ref)] of the nominal model
  pd_gravity,       ///< tau = kp e + kd e' + G of the nominal model
};

struct ControllerSpec {
  ControllerKind kind = ControllerKind::computed_torque;
  /// Natural frequency of the closed loop, rad/s; 0: 15, or 0.4 / control period if that is less.
  double bandwidth_rad_s = 0.0;
  double damping = 1.0;  ///< of the closed loop, 1 is critical
  bool friction_compensation = true;
  /// The controller's model is the robot with mass and inertia of link i multiplied by 1 + mass_error[i];
  /// empty: no error.
  std::vector<double> mass_error{};
  /// The controller's model, before `mass_error`; empty: the simulated robot.
  std::optional<Chain> nominal{};
};

/// Computes the commanded torque from a reference and a measurement. No state, no heap allocation per call.
class Controller {
 public:
  /// Throws Error(usage) if `spec` does not fit the robot.
  Controller(const Robot& robot, const ControllerSpec& spec, double control_period_s);

  void torque(const Reference& reference, const JointVector& q, const JointVector& dq,
              JointVector& tau) const;

 private:
  ControllerSpec spec_;
  FastDynamics nominal_;
  double kp_ = 0.0;      ///< 1/s^2
  double kd_ = 0.0;      ///< 1/s
  JointVector inertia_;  ///< diagonal of M at q = 0, which scales the gains of pd_gravity
};

}  // namespace faultline
