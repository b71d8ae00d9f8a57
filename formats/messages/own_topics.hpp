// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace faultline {

/// Topics under which this program writes a log: the joints with position, velocity and torque, what was
/// commanded, what was measured beside it, and the channels without a canonical meaning, by their names as
/// joints.
inline constexpr const char* kStatesTopic = "/joint_states";
inline constexpr const char* kCommandsTopic = "/joint_commands";
inline constexpr const char* kMeasuredTopic = "/joint_torques_measured";
inline constexpr const char* kExtraTopic = "/faultline/extra";

/// What a diagnosis computed from a log: joints as they were predicted one step ahead, with the torque that
/// the healthy robot needs for the motion; residuals; how the evidence of a fault grew, a topic a fault.
inline constexpr const char* kPredictedTopic = "/faultline/predicted";
inline constexpr const char* kResidualsTopic = "/faultline/residuals";
inline constexpr const char* kEvidenceTopic = "/faultline/evidence";

/// No part of the log, when a recording is read.
constexpr bool is_computed(std::string_view topic) {
  return topic == kPredictedTopic || topic == kResidualsTopic;
}

}  // namespace faultline
