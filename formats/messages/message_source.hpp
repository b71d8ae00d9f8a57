// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "formats/byte_source.hpp"
#include "lib/core/issue.hpp"
#include "lib/log/raw_reader.hpp"

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
  explicit MessageSource(std::unique_ptr<ByteSource> bytes) : bytes_(std::move(bytes)) {}
  virtual ~MessageSource() = default;
  const std::string& path() const { return bytes_->path(); }
  virtual const char* format() const = 0;
  /// Topics met so far; the list only grows.
  virtual const std::vector<Topic>& topics() const = 0;
  /// False after the last one.
  virtual bool next(Message& message) = 0;
  /// Starts again, with issues empty; the topics stay.
  virtual void rewind() = 0;
  const Issues& issues() const { return issues_; }
  /// Counts work on the message, see WorkBudget.
  virtual void spend(std::int64_t work_ns) { bytes_->spend(work_ns); }
  /// SHA-256 of the file once its end was reached, empty before.
  const std::string& sha256() const { return bytes_->sha256(); }
  virtual double share_read() const { return bytes_->share_read(); }

 protected:
  std::unique_ptr<ByteSource> bytes_;
  Issues issues_;
};

/// Finds the messages that are missing in damaged chunks by the index after each chunk. Channels have the
/// numbers of the file.
class LostMessages {
 public:
  /// Begins a chunk, which is complete unless lose() is called.
  void begin_chunk();
  void lose() { lossy_ = true; }
  bool is_lossy() const { return lossy_; }
  /// Counts a message of the chunk that was handed out.
  void met(std::uint32_t channel) { ++met_[channel]; }
  /// Takes the index after the chunk; messages of a topic beyond those counted by met() are missing.
  void compare(std::uint32_t channel, std::size_t messages, int topic);
  /// Returns the next missing message; false when there is none.
  bool next(Message& message);

 private:
  std::map<std::uint32_t, std::size_t> met_;  ///< in the present chunk
  std::vector<int> topics_;                   ///< of missing messages
  std::size_t given_ = 0;
  bool lossy_ = false;
};

/// Opens the sensor_msgs/JointState messages of a recording as a table. The joints are found in its first
/// part; messages with other joints later are reported as issues. Throws Error(input) without such messages.
std::unique_ptr<RawReader> read_joint_states(std::unique_ptr<MessageSource> source);

/// Topics under which this program writes a log: the joints with position, velocity and torque, the commands,
/// the separately measured torques, and the channels without a canonical meaning, with their names as joint
/// names.
inline constexpr const char* kStatesTopic = "/joint_states";
inline constexpr const char* kCommandsTopic = "/joint_commands";
inline constexpr const char* kMeasuredTopic = "/joint_torques_measured";
inline constexpr const char* kExtraTopic = "/faultline/extra";

/// Results of a diagnosis: positions and velocities predicted one step ahead, with the torque that the
/// healthy robot needs for the motion; residuals; the evidence of each fault over time, one topic per fault.
inline constexpr const char* kPredictedTopic = "/faultline/predicted";
inline constexpr const char* kResidualsTopic = "/faultline/residuals";
inline constexpr const char* kEvidenceTopic = "/faultline/evidence";

/// True for joint states that a diagnosis computed; they are not part of the log.
constexpr bool is_computed(std::string_view topic) {
  return topic == kPredictedTopic || topic == kResidualsTopic;
}

}  // namespace faultline
