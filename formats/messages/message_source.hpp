// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "lib/core/issue.hpp"

namespace faultline {

/// A named stream of messages of one type in a recording.
struct Topic {
  std::string name;
  std::string type;      ///< such as "sensor_msgs/msg/JointState"
  std::string encoding;  ///< of the messages: "cdr", "ros1", "json"; others cannot be read
};

/// Bytes to which each text of a topic is cut; no name is as long.
inline constexpr std::size_t kLongestTopicText = 1 << 12;

/// The topics of a recording, in the order in which they are met.
class TopicList {
 public:
  /// `path` is used in messages.
  explicit TopicList(std::string path) : path_(std::move(path)) {}
  /// Returns the index of a topic and adds it if it is new; messages of a second publisher or of a restarted
  /// driver belong to the same topic. Throws Error(input) when there are more than any recording has.
  int add(Topic topic);
  const std::vector<Topic>& all() const { return topics_; }

 private:
  std::string path_;
  std::vector<Topic> topics_;
  std::map<std::tuple<std::string, std::string, std::string>, int> index_of_;
  std::size_t bytes_ = 0;
};

/// One message. The bytes are valid until the next call of next().
struct Message {
  int topic = 0;                ///< index in MessageSource::topics()
  std::int64_t receipt_ns = 0;  ///< time of receipt by the recorder, since 1970 or another start
  std::string_view bytes;
  bool lost = false;  ///< its bytes are damaged or missing; it is only counted
};

/// A recording of messages in the order of receipt, up to damage and, if the format allows, after it. Every
/// failure to read the file throws Error(input).
class MessageSource {
 public:
  virtual ~MessageSource() = default;
  virtual const std::string& path() const = 0;
  virtual const char* format() const = 0;
  /// Topics met so far; the list only grows.
  virtual const std::vector<Topic>& topics() const = 0;
  /// False after the last one.
  virtual bool next(Message& message) = 0;
  /// Starts again, with issues empty; the topics stay.
  virtual void rewind() = 0;
  virtual const Issues& issues() const = 0;
  /// Counts work on the message, see WorkBudget.
  virtual void spend(std::int64_t work_ns) = 0;
  /// SHA-256 of the file once its end was reached, empty before.
  virtual const std::string& sha256() const = 0;
  virtual double share_read() const = 0;
};

}  // namespace faultline
