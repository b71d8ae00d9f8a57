// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/identify/usual_motion.hpp"
#include "lib/log/log.hpp"
#include "lib/robot/robot.hpp"

namespace faultline {

/// The identified robot that a log is compared with, and its usual motion.
struct KnownRobot {
  const Robot& robot;
  const UsualMotion& usual;

  const Chain& chain() const { return robot.chain; }
  int joints() const { return robot.joints(); }
  double torque_phi() const { return robot.torque_phi.value_or(0.0); }
};

/// The torque of one joint as means over windows of a tenth of a second or more in which the joint moves, in
/// the order of time.
struct JointBalance {
  std::vector<double> time_s;   ///< start of each window
  std::vector<double> logged;   ///< N m or N
  std::vector<double> body;     ///< required for inertia and gravity along the logged motion, N m or N
  std::vector<double> braking;  ///< required for friction and ripple, N m or N
  /// Measured velocity over the derivative of the position if they are one quantity in two units; else 1.
  double velocity_factor = 1.0;

  std::size_t windows() const { return logged.size(); }
};

/// Computes the torque that the robot needs for the motion of a log, beside the logged torque, by joint.
/// Without windows if the motion cannot be computed (too few rows, no torque).
std::vector<JointBalance> torque_balance(const Log& log, const KnownRobot& robot);

/// Returns the misfit of each block of successive windows: root mean square of logged minus required torque
/// over the standard deviation of the torque. An offset and half to twice the friction are fitted first. In a
/// block whose torque varies by less than a tenth of `torque_scale` (largest healthy torque), the misfit is
/// relative to the mean torque and without an offset; a block in which that is small too is left out.
std::vector<double> misfits(const JointBalance& balance, double torque_scale);

/// The factor from required to logged torque, and the share of the logged torque's standard deviation that
/// remains as residual.
struct TorqueRatio {
  double ratio = 0.0;  ///< 0 if the torque varies too little
  double left = 1.0;
};
/// Fits the ratio over all windows, with an offset.
TorqueRatio torque_ratio(const JointBalance& balance, double torque_scale);

}  // namespace faultline
