// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/identify/usual_motion.hpp"
#include "lib/log/log.hpp"
#include "lib/robot/robot.hpp"

namespace faultline {

/// The identified robot that a log is held against, and its usual motion.
struct KnownRobot {
  const Robot& robot;
  const UsualMotion& usual;

  const Chain& chain() const { return robot.chain; }
  int joints() const { return robot.joints(); }
  double torque_phi() const { return robot.torque_phi.value_or(0.0); }
};

/// The torque of one joint in means over windows of a tenth of a second or more in which the joint moves, in
/// the order of time.
struct JointBalance {
  std::vector<double> time_s;   ///< start of each window
  std::vector<double> logged;   ///< N m or N
  std::vector<double> body;     ///< that moves and holds the bodies along the logged motion
  std::vector<double> braking;  ///< that friction and ripples take
  /// Measured velocity over the derivative of the position, where they are one quantity in two units; else 1.
  double velocity_factor = 1.0;

  std::size_t windows() const { return logged.size(); }
};

/// What the robot needs for a log's motion beside what was logged, by joint. Where the log tells no motion
/// (too few rows, no torque), there are no windows.
std::vector<JointBalance> torque_balance(const Log& log, const KnownRobot& robot);

/// How far the torque of successive windows is from what the robot needs, a number for each block of them:
/// the root mean square of what is left as a share of how much it varies. Another offset and half to twice
/// the friction are no misfit. A torque that varies by less than a tenth of `torque_scale` (largest healthy
/// torque) must be the right one itself, and says nothing where it is small.
std::vector<double> misfits(const JointBalance& balance, double torque_scale);

/// The factor that takes the torque that is needed to the one that was logged, and the share that is left
/// then.
struct TorqueRatio {
  double ratio = 0.0;  ///< 0 where too little varies
  double left = 1.0;
};
/// Over all windows.
TorqueRatio torque_ratio(const JointBalance& balance, double torque_scale);

}  // namespace faultline
