// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/robot/robot.hpp"

namespace faultline {

/// Gears that give way, one number each a joint; empty: rigid gears.
struct GearSpec {
  std::vector<double> stiffness{};  ///< N m/rad or N/m; 0: rigid
  std::vector<double> damping{};    ///< of the spring, N m s/rad or N s/m
  std::vector<double> play{};       ///< full width of the dead zone, rad or m
  /// Of the motor, seen at the joint, kg m^2 or kg; 0: the robot's rotor inertia.
  std::vector<double> motor_inertia{};
};

/// The robot with rigid gears: rotor inertias are those of the motors, where the spec gives them.
Robot with_motors(Robot robot, const GearSpec& spec);

/// Throws Error(usage) naming the key when `spec` does not fit the robot.
void check_gears(const Robot& robot, const GearSpec& spec);

/// Springs between motors and links (Spong 1987: the motor's kinetic energy is that of its own rotation
/// alone), with play. Motor inertia, friction and ripple of a joint with a spring are on its motor's side.
class Gears {
 public:
  /// `chain` is that of a robot with_motors(); `spec` fits it.
  Gears(const Chain& chain, const GearSpec& spec);

  /// Bit j: joint j (from 0) has a spring.
  unsigned springs() const { return springs_; }
  bool has_spring(int joint) const { return springs_ >> joint & 1u; }
  double motor_inertia(int joint) const { return motor_inertia_[joint]; }

  /// What the gear of a joint with a spring passes to its link when the motor is `twist` ahead of it and
  /// gains at `rate`, N m or N. Where there is play, no torque and no damping within it, and a flank pushes
  /// but never pulls.
  double torque(int joint, double twist, double rate) const;
  /// The twist at rest under that torque, the middle of the play under none.
  double twist_under(int joint, double torque) const;

  /// The chain without what is on the motors' side.
  Chain link_side(Chain chain) const;
  /// Bound of the rate of the springs' vibrations (1/s) between motors and links of that mobility (diagonal
  /// of M^-1), and of their damping.
  double vibration_rate(const JointVector& link_mobility) const;
  double damping_rate(const JointVector& link_mobility) const;

 private:
  std::vector<double> stiffness_, damping_, play_, motor_inertia_;
  unsigned springs_ = 0;
};

}  // namespace faultline
