// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace faultline {

/// The source of a canonical channel ("t", "q1", "dq2", "tau3", "q_ref1", "dq_ref1", "tau_ref1", "tau_meas1")
/// and its conversion to SI: value = sign * scale * (raw * unit factor) + offset.
struct ColumnSpec {
  /// Column in the file; of a recording of messages, the field of a message after its topic and a slash.
  /// Empty = find by the usual names.
  std::string name{};
  std::string unit{};  ///< such as "deg", "mm", "ms", "ns"; empty = SI
  double sign = 1.0;   ///< +1 or -1
  double scale = 1.0;
  double offset = 0.0;  ///< in SI, added last
  std::string topic{};  ///< of the messages of which the column is a field; empty for other columns
};

/// The columns of a log by canonical channel name; other channels are found by their usual names.
using ColumnMap = std::map<std::string, ColumnSpec>;

/// The time of a message that the log uses: that of its header, or that of its receipt by the recorder.
enum class MessageTime { header, receipt };

constexpr const char* to_string(MessageTime time) {
  return time == MessageTime::header ? "header" : "receipt";
}

/// A value in the messages of a topic, such as "q[3]" or "interface_values[0].values[2]".
struct MessageFieldName {
  std::string topic, field;
};

/// The part of a recording of messages that is the log.
struct RecordingChoice {
  std::string topic{};                     ///< topic whose messages are the rows; empty = the most likely one
  std::vector<std::string> joints{};       ///< from base to tip, by their names in the messages; empty = all
  std::optional<MessageTime> time{};       ///< nullopt = header if the message has one
  std::vector<MessageFieldName> fields{};  ///< that are columns beside the joint states
};

}  // namespace faultline
