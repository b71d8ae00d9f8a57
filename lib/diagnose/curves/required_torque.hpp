// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <functional>

#include "lib/diagnose/diagnosis.hpp"
#include "lib/log/log.hpp"
#include "lib/log/log_source.hpp"
#include "lib/model/model.hpp"

namespace faultline {

/// Torque that the robot needs for the motion of a log, in terms of the logged torque: inverse dynamics along
/// the smoothed motion (smooth_motion()), a row's torque being the mean over the step that it acts in.
/// joints x rows of the segment, N m or N; NaN at the last row of a stretch, at incomplete rows between two
/// stretches, and in stretches too short to be smoothed.
using RequiredTorque = Eigen::MatrixXd;

/// Calls `visit` for each segment with its required torque, which is empty if the log lacks torque or the
/// model mechanics. Reads the log twice from its first row. Memory does not grow with the log, and the
/// numbers do not depend on segment borders.
void for_each_with_required_torque(LogSource& log, const Model& model, const Diagnosis& diagnosis,
                                   const std::function<void(const Log&, const RequiredTorque&)>& visit);

}  // namespace faultline
