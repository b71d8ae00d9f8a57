// SPDX-License-Identifier: MIT
#pragma once

#include "lib/evidence/bank.hpp"
#include "lib/evidence/filter/joint_array.hpp"
#include "lib/evidence/motion_model.hpp"

namespace faultline {

/// A robot whose faults were named, so that the filter can go on with them: what is not in the filter's state
/// stands here.
struct FaultyRobot {
  MotionModel model;    ///< with the friction that was added
  KnownFaults faults;   ///< of its sensors, and joints of which nothing is known any more
  JointFlags closed{};  ///< joints at which nothing else can be told any more
  /// False where the fault took a joint out of sight: how well the log is explained then tells nothing.
  bool explains = true;
};

/// Makes `robot` one that has the fault that `found` says too. Returns the state of its filter, with torques
/// and masses as they are now.
GaussianState take_fault(FaultyRobot& robot, const Hypothesis& hypothesis, const RunningHypothesis& found);

}  // namespace faultline
