// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace faultline {

/// An array of doubles as stored in a message.
struct PackedNumbers {
  const char* data = nullptr;
  std::size_t count = 0;
  bool swapped = false;  ///< big-endian

  double operator[](std::size_t i) const;
};

/// The content of a sensor_msgs/JointState; valid as long as the bytes of the message and, for JSON, until
/// the next one is decoded.
struct JointMessage {
  std::int64_t stamp_ns = 0;  ///< of its header
  std::string_view names;     ///< encoded: equal bytes mean equal names; see decode_names()
  PackedNumbers position, velocity, effort;
};

/// Reads the messages of one encoding.
class JointStateDecoder {
 public:
  virtual ~JointStateDecoder() = default;
  /// False when the bytes are not a complete JointState.
  virtual bool decode(std::string_view bytes, JointMessage& state) = 0;
  virtual std::vector<std::string> decode_names(const JointMessage& state) const = 0;
};

/// True when a type, as ROS 1, ROS 2 or a schema writes it, is a JointState.
bool is_joint_state(std::string_view type);

/// Returns a decoder for "cdr" (ROS 2, either byte order), "ros1" or "ros1msg", and "json"; null for others.
std::unique_ptr<JointStateDecoder> joint_state_decoder(std::string_view encoding);

}  // namespace faultline
