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

/// Bytes of each text of a topic that are kept; no name is as long.
inline constexpr std::size_t kLongestTopicText = 1 << 12;

/// The topics of a recording as they are met.
class TopicList {
 public:
  /// `path` for messages.
  explicit TopicList(std::string path) : path_(std::move(path)) {}
  /// The index of a topic, which is added unless it is there: what a second publisher or a driver that was
  /// started again sends belongs to the same one. Throws Error(input) when there are more than any recording
  /// has.
  int add(Topic topic);
  const std::vector<Topic>& all() const { return topics_; }

 private:
  std::string path_;
  std::vector<Topic> topics_;
  std::map<std::tuple<std::string, std::string, std::string>, int> index_of_;
  std::size_t bytes_ = 0;
};

/// One message. The bytes are valid until the next one is asked for.
struct Message {
  int topic = 0;                ///< index in MessageSource::topics()
  std::int64_t receipt_ns = 0;  ///< when the recorder received it, since 1970 or since some start
  std::string_view bytes;
  bool lost = false;  ///< its bytes are damaged or missing; only to be counted
};

/// A recording of messages in the order in which they were received, up to damage and behind it where the
/// format allows. Every failure of reading the file throws Error(input).
class MessageSource {
 public:
  virtual ~MessageSource() = default;
  virtual const std::string& path() const = 0;
  virtual const char* format() const = 0;
  /// Those met so far; only ever gets longer.
  virtual const std::vector<Topic>& topics() const = 0;
  /// False after the last one.
  virtual bool next(Message& message) = 0;
  /// Starts again, with issues empty; the topics stay.
  virtual void rewind() = 0;
  virtual const Issues& issues() const = 0;
  /// Counts work on the message, see WorkBudget.
  virtual void spend(std::int64_t work_ns) = 0;
  /// Of the file once its end was reached, empty before.
  virtual const std::string& sha256() const = 0;
  virtual double share_read() const = 0;
};

}  // namespace faultline
