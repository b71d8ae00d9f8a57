// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace faultline {

/// Types of single values in a message of ROS.
enum class MessageValue {
  boolean,
  int8,
  uint8,
  int16,
  uint16,
  int32,
  uint32,
  int64,
  uint64,
  float32,
  float64,
  text
};

/// Returns the bytes of a value; 0 for a text, whose length is part of the message.
std::size_t bytes_of(MessageValue value);

/// How often a field holds its type: once, as often as the definition says, or as often as the message says.
enum class MessageCount { one, fixed, listed };

struct MessageField {
  std::string name;
  MessageValue value = MessageValue::float64;
  int group = -1;  ///< index of a group of the definition; -1 for a single value
  MessageCount count = MessageCount::one;
  std::uint32_t size = 0;  ///< of a fixed array
};

/// Fields that stand together under a type of their own, such as std_msgs/Header.
struct MessageGroup {
  std::string type;  ///< such as "std_msgs/Header"
  std::vector<MessageField> fields;
};

/// What the bytes of a message mean. The message itself is the first group.
struct MessageDefinition {
  std::vector<MessageGroup> groups;
};

/// Returns the type without the part that ROS 2 inserts: "control_msgs/msg/JointJog" and
/// "control_msgs::msg::JointJog" give "control_msgs/JointJog".
std::string plain_type(std::string_view type);

/// Parses a definition of ROS 1 or ROS 2 as recordings store it: the fields of the message `type`, then those
/// of each further type after a line of "=" and a line "MSG: type" (https://mcap.dev/spec/registry,
/// wiki.ros.org/msg). Times and durations have the fields `sec` and `nanosec`. Returns nullopt for a text
/// that is no such definition, lacks a type, contains itself, or names more fields than a message has.
std::optional<MessageDefinition> parse_definition(std::string_view type, std::string_view text);

/// Returns the definitions of a type that recordings of rosbag2 before ROS 2 Iron do not state, for the
/// messages of controllers; the versions of control_msgs have different fields, newest first. Empty for other
/// types.
std::vector<MessageDefinition> known_definitions(std::string_view type);

}  // namespace faultline
