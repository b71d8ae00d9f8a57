// SPDX-License-Identifier: MIT
#pragma once

namespace faultline {

/// Topics under which this program writes a log: the joints with position, velocity and torque, what was
/// commanded, what was measured beside it, and the channels without a canonical meaning, by their names as
/// joints.
inline constexpr const char* kStatesTopic = "/joint_states";
inline constexpr const char* kCommandsTopic = "/joint_commands";
inline constexpr const char* kMeasuredTopic = "/joint_torques_measured";
inline constexpr const char* kExtraTopic = "/faultline/extra";

}  // namespace faultline
