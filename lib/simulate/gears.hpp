// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/robot/robot.hpp"

namespace faultline {

/// Compliant gears, one number for each joint; empty: rigid gears.
struct GearSpec {
  std::vector<double> stiffness{};  ///< N m/rad or N/m; 0: rigid
  std::vector<double> damping{};    ///< of the spring, N m s/rad or N s/m
  std::vector<double> play{};       ///< full width of the dead zone, rad or m
  /// Inertia of the motor, seen at the joint, kg m^2 or kg; 0: the robot's rotor inertia.
  std::vector<double> motor_inertia{};
};

/// Returns the robot with rigid gears and, if the spec gives them, the rotor inertias of the motors.
Robot with_motors(Robot robot, const GearSpec& spec);

/// Throws Error(usage) naming the key if `spec` does not fit the robot.
void check_gears(const Robot& robot, const GearSpec& spec);

/// Springs between motors and links, with play (Spong 1987: the kinetic energy of a motor is that of its own
/// rotation alone). Motor inertia, friction and ripple of a joint with a spring act on the motor's side.
class Gears {
 public:
  /// `chain` is that of a robot with_motors(); `spec` must fit it.
  Gears(const Chain& chain, const GearSpec& spec);

  /// Bit j is set if joint j (from 0) has a spring.
  unsigned springs() const { return springs_; }
  bool has_spring(int j) const { return springs_ >> j & 1u; }
  double motor_inertia(int j) const { return motor_inertia_[j]; }

  /// Returns the torque (N m or N) that the gear of a joint with a spring passes to its link if the motor is
  /// ahead of the link by `twist`, which grows at `rate`. A gear with play has neither torque nor damping
  /// within the play, and its flanks push but never pull.
  double torque(int j, double twist, double rate) const;
  /// Returns the twist at rest under that torque; 0, the middle of the play, without torque.
  double twist_under(int j, double torque) const;

  /// Returns the chain without friction, rotor inertia and ripple of the joints with springs.
  Chain link_side(Chain chain) const;
  /// Upper bounds (1/s) of the rate of the springs' vibrations between motors and links of that mobility
  /// (diagonal of M^-1), and of the rate of their damping.
  double vibration_rate(const JointVector& link_mobility) const;
  double damping_rate(const JointVector& link_mobility) const;

 private:
  std::vector<double> stiffness_, damping_, play_, motor_inertia_;
  unsigned springs_ = 0;
};

}  // namespace faultline
