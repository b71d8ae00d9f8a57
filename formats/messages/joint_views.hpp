// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "formats/messages/encode_joint_state.hpp"
#include "formats/messages/message_content.hpp"
#include "formats/messages/message_source.hpp"

namespace faultline {

/// What a message of a controller says of its joints from one side: measured, as reference, or as command.
struct JointView {
  TopicRole role = TopicRole::unknown;
  const char* name = "";            ///< such as "feedback"; follows the topic's name in the columns
  std::vector<std::string> joints;  ///< their names; empty if the message has none
  JointRow row;                     ///< positions, velocities, efforts
};

/// True for a type of which joint_views() reads the messages.
bool has_joint_views(std::string_view type);

/// Returns the views of a message, the measured one last, so that a row holds the reference of its own
/// message: control_msgs/JointTrajectoryControllerState with old and new names,
/// control_msgs/DynamicJointState, trajectory_msgs/JointTrajectory with one point, franka_msgs/FrankaState
/// and FrankaRobotState, ur_msgs/RobotStateRTMsg. Empty for a message without positions, and for other types.
std::vector<JointView> joint_views(std::string_view type, const MessageContent& content);

}  // namespace faultline
