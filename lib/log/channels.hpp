// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace faultline {

/// Where a canonical channel ("t", "q1", "dq2", "tau3", "q_ref1", "dq_ref1", "tau_ref1", "tau_meas1") comes
/// from and how its raw value becomes SI: value = sign * scale * (raw * unit factor) + offset.
struct ColumnSpec {
  std::string name{};  ///< column in the file; empty = find by the usual names
  std::string unit{};  ///< such as "deg", "mm", "ms", "ns"; empty = SI
  double sign = 1.0;   ///< +1 or -1
  double scale = 1.0;
  double offset = 0.0;  ///< in SI, added last
};

/// The meaning of a log's columns by canonical channel name; what is not named is found by the usual names.
using ColumnMap = std::map<std::string, ColumnSpec>;

/// Which time of a message counts: that in its header, or that when the recorder received it.
enum class MessageTime { header, receipt };

const char* to_string(MessageTime time);

/// Which part of a recording of messages is the log.
struct RecordingChoice {
  std::string topic{};  ///< whose messages are the rows; empty = the one that looks most like it
  std::vector<std::string> joints{};  ///< base to tip, as the messages name them; empty = all
  std::optional<MessageTime> time{};  ///< none = header where it has one
};

}  // namespace faultline
