// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace faultline {

/// Topics under which this program writes a log: the joints with position, velocity and torque, the commands,
/// the separately measured torques, and the channels without a canonical meaning, with their names as joint
/// names.
inline constexpr const char* kStatesTopic = "/joint_states";
inline constexpr const char* kCommandsTopic = "/joint_commands";
inline constexpr const char* kMeasuredTopic = "/joint_torques_measured";
inline constexpr const char* kExtraTopic = "/faultline/extra";

/// Results of a diagnosis: positions and velocities predicted one step ahead, with the torque that the
/// healthy robot needs for the motion; residuals; the evidence of each fault over time, one topic per fault.
inline constexpr const char* kPredictedTopic = "/faultline/predicted";
inline constexpr const char* kResidualsTopic = "/faultline/residuals";
inline constexpr const char* kEvidenceTopic = "/faultline/evidence";

/// True for joint states that a diagnosis computed; they are not part of the log.
constexpr bool is_computed(std::string_view topic) {
  return topic == kPredictedTopic || topic == kResidualsTopic;
}

}  // namespace faultline
