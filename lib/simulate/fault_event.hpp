// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <string>

#include "lib/core/joint.hpp"
#include "lib/fault/fault_kind.hpp"
#include "lib/robot/robot.hpp"

namespace faultline {

/// A fault that happens during a simulated run.
struct SimulatedFault {
  FaultKind kind = FaultKind::none;
  Joint joint{};         ///< for a payload_change that of the link that carries it, none: the last one
  double onset_s = 0.0;  ///< the first moment at which it acts; need not be a sample
  double end_s = std::numeric_limits<double>::infinity();  ///< the first moment at which it no longer acts
  /// torque_loss: share lost, 0 to 1. sensor_bias: rad or m. sensor_drift: rad/s or m/s. friction_increase:
  /// added Coulomb friction, N m or N. payload_change: kg added at the end of the link, may be negative.
  /// collision: torque on the joint, N m or N. torque_sensor_error: logged minus acting torque, N m or N.
  double size = 0.0;
  double viscous = 0.0;  ///< friction_increase: added viscous friction, N m s/rad or N s/m
};

/// Effect of a fault on the machine while it acts; by default none.
struct MachineFault {
  double torque_gain = 1.0;      ///< of the joint's drive
  double external_torque = 0.0;  ///< on the link, N m or N
  double drive_offset = 0.0;     ///< of the joint's drive, N m or N
  double coulomb = 0.0;          ///< added friction, N m or N
  double viscous = 0.0;          ///< added friction, N m s/rad or N s/m
  double payload = 0.0;          ///< added at the end of the joint's link, kg
  bool locks = false;
  double reading_offset = 0.0;       ///< of the measured position, rad or m
  double reading_drift_per_s = 0.0;  ///< of the measured position, rad/s or m/s, since the onset
  bool reading_sticks = false;       ///< measured position and velocity repeat
};
MachineFault machine_fault(const SimulatedFault& fault);

/// Throws Error(usage) with the reason if `fault` cannot happen to `robot`.
void check_fault(const Robot& robot, const SimulatedFault& fault);

/// Unit of `SimulatedFault::size` for this fault, "" if it has no size.
std::string size_unit(const Robot& robot, const SimulatedFault& fault);

}  // namespace faultline
