// SPDX-License-Identifier: MIT
#pragma once

#include "formats/messages/joint_state.hpp"

namespace faultline {

/// Messages as JSON objects with the members of the ROS message; the stamp's nanoseconds are "nsec",
/// "nanosec" or "nsecs", its seconds "sec" or "secs".
std::unique_ptr<JointStateDecoder> json_joint_state_decoder();

}  // namespace faultline
