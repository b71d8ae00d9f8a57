// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace faultline {

/// Positions, velocities and efforts of joints in one row; an array that the log lacks is empty.
using JointRow = std::array<std::vector<double>, 3>;

/// Writes sensor_msgs/JointState messages of ROS 2 as little-endian CDR.
class JointStateEncoder {
 public:
  explicit JointStateEncoder(const std::vector<std::string>& names);
  /// Appends a message.
  void append(std::int64_t stamp_ns, const JointRow& row, std::string& out) const;
  /// Type and definition, as a recording declares it.
  static constexpr const char* kType = "sensor_msgs/msg/JointState";
  static constexpr const char* kDefinition =
      "std_msgs/Header header\nstring[] name\nfloat64[] position\nfloat64[] velocity\nfloat64[] effort\n"
      "================================================================================\n"
      "MSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n"
      "================================================================================\n"
      "MSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n";

 private:
  std::string names_;  ///< encoded, after the frame
};

}  // namespace faultline
