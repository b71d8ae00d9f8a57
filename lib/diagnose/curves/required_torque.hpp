// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <functional>

#include "lib/diagnose/diagnosis.hpp"
#include "lib/log/log.hpp"
#include "lib/log/log_source.hpp"
#include "lib/model/model.hpp"

namespace faultline {

/// The robot as it was on the day of a log, and what its drives make of a logged torque.
struct RobotOfTheDay {
  Chain chain;
  std::vector<double> gain, offset;  ///< by joint: the drive gives gain * logged torque + offset, N m or N
  double torque_phi = 0.0;           ///< MotionModel::torque_phi
};

/// The identified robot with the friction, drives and tip mass that the diagnosis estimated for the log
/// (Diagnosis::condition).
RobotOfTheDay robot_of_the_day(const Model& model, const std::vector<ConditionItem>& condition);

/// Torque that the robot needs for the motion that a log shows, as its log would hold it: inverse dynamics
/// along the smoothed motion (smooth_motion()), a row's torque being the mean over the step that it acts in.
/// joints x rows of the segment, N m or N; NaN at the last row of a stretch, near rows that are missing, and
/// in stretches too short to be smoothed.
using RequiredTorque = Eigen::MatrixXd;

/// Reads the log twice from its first row and hands out each segment with its required torque, which is empty
/// where the log lacks torque or the model mechanics. Memory does not grow with the log, and where segments
/// end changes no number.
void for_each_with_required_torque(LogSource& log, const Model& model, const Diagnosis& diagnosis,
                                   const std::function<void(const Log&, const RequiredTorque&)>& visit);

}  // namespace faultline
