// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "formats/messages/message_source.hpp"
#include "lib/log/raw_reader.hpp"

namespace faultline {

/// Opens the sensor_msgs/JointState messages of a recording as a table. The joints are found in its first
/// part; messages with other joints later are reported as issues. Throws Error(input) without such messages.
std::unique_ptr<RawReader> read_joint_states(std::unique_ptr<MessageSource> source);

}  // namespace faultline
