// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "lib/log/log_source.hpp"
#include "lib/model/model.hpp"

namespace faultline {

/// Whether none of the logs has a torque of any meaning. Rewinds them.
bool lack_torque(std::span<LogSource* const> logs);

/// Learns how the joints follow their references, from healthy logs without torque; the model judges nothing
/// else. Throws Error(input) when the logs have other joints than the robot, or no joint follows a reference.
Model tracking_model(std::span<LogSource* const> healthy, const Robot& robot, double alarms_per_hour);

}  // namespace faultline
