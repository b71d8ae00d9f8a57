// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace faultline {

/// A message of a recording as it stands there.
struct RecordedMessage {
  std::uint64_t time_ns = 0;
  std::string bytes;
};

/// What an MCAP file holds, read by its specification and not by the reader of the program.
struct RecordedFile {
  std::map<std::string, std::vector<RecordedMessage>> messages;  ///< by topic
  std::map<std::string, std::string> encoding;                   ///< of messages, by topic
  std::map<std::string, std::string> metadata;                   ///< by name, the value of key "json"
};

RecordedFile read_mcap(const std::string& path);

/// The arrays of a sensor_msgs/JointState message in little-endian CDR: position, velocity, effort.
std::vector<std::vector<double>> joint_state_arrays(const std::string& bytes);

}  // namespace faultline
