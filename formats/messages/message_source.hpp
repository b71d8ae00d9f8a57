// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "formats/byte_source.hpp"
#include "formats/bytes/unpack_block.hpp"
#include "lib/core/issue.hpp"
#include "lib/core/text.hpp"
#include "lib/log/raw_reader.hpp"

namespace faultline {

/// What the messages of a topic say of the joints, where that is known; `unknown` leaves it to the names.
enum class TopicRole { unknown, measured, reference, commanded_torque, fields };

/// A named stream of messages of one type in a recording.
struct Topic {
  std::string name;
  std::string type;      ///< such as "sensor_msgs/msg/JointState"
  std::string encoding;  ///< of the messages: "cdr", "ros1", "json"; others cannot be read
  std::string
      definition{};  ///< of the type, in the language of ROS; empty if the recording does not state it
  TopicRole role = TopicRole::unknown;
};

/// Returns the name of a topic or a joint in quotation marks, shortened.
inline std::string in_quotes(std::string_view name) { return "\"" + shortened(name, kLongestName) + "\""; }

/// Returns "its topics are ..", with names, types and encodings.
std::string topics_sentence(const std::vector<Topic>& topics);

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
class MessageStream {
 public:
  virtual ~MessageStream() = default;
  virtual const std::string& path() const = 0;
  /// Name of the format in LogIdentity.
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
  /// Share of the file read so far, 0 to 1.
  virtual double share_read() const = 0;
};

/// The messages of a file.
class MessageSource : public MessageStream {
 public:
  MessageSource(std::unique_ptr<ByteSource> bytes, const char* format)
      : bytes_(std::move(bytes)), topics_(bytes_->path()), format_(format) {}
  const std::string& path() const override { return bytes_->path(); }
  const char* format() const override { return format_; }
  const std::vector<Topic>& topics() const override { return topics_.all(); }
  const Issues& issues() const override { return issues_; }
  void spend(std::int64_t work_ns) override { bytes_->spend(work_ns); }
  const std::string& sha256() const override { return bytes_->sha256(); }
  double share_read() const override { return bytes_->share_read(); }

 protected:
  std::unique_ptr<ByteSource> bytes_;
  TopicList topics_;
  Issues issues_;

 private:
  const char* format_;
};

/// A recording with messages in chunks, each followed by an index, that is read from front to back. The index
/// of a damaged chunk shows which of its messages are missing. Channels have the numbers of the file.
class ChunkedSource : public MessageSource {
 public:
  bool next(Message& message) override;
  void rewind() override;

 protected:
  /// Kind of a record that was taken; `nothing` if there was none.
  enum class Taken { message, other, nothing };

  ChunkedSource(std::unique_ptr<ByteSource> bytes, const char* format)
      : MessageSource(std::move(bytes), format), window_(*bytes_) {}
  /// Begins at the front of the window.
  virtual void start() = 0;
  /// Takes the next record of the open chunk, if one is open.
  virtual Taken next_inside(Message& message) = 0;
  /// Takes the next record outside chunks.
  virtual Taken next_record(Message& message) = 0;
  /// Makes the checks that need the whole file.
  virtual void check_end() {}

  /// Hands out `found`, a message of a channel, unless its topic is unknown (negative), which is reported:
  /// `what` is the file's word for a channel.
  Taken give(const Message& found, const char* what, std::uint32_t channel, Message& message);
  /// Begins a chunk, which is complete unless lose_chunk() is called.
  void begin_chunk();
  /// Reports damage of the chunk. Its messages may be wrong, and are only counted, if it is `doubtful`.
  void lose_chunk(const std::string& why, bool doubtful);
  /// Replaces the bytes of a chunk by the unpacked ones, `size` if it is undamaged, which are valid until the
  /// next chunk. Reports a chunk that is damaged or in which the file ends; a checksum of 0 is none.
  void unpack(BlockPacking packing, std::uint64_t size, std::uint32_t checksum, bool is_cut,
              std::string_view& bytes);
  bool is_lossy() const { return lossy_; }
  bool is_doubtful() const { return doubtful_; }
  /// Takes the index after a chunk; messages of a topic beyond those given are missing in a lossy chunk.
  void compare(std::uint32_t channel, std::size_t messages, int topic);

  ByteWindow window_;

 private:
  BlockBytes unpacked_;
  std::map<std::uint32_t, std::size_t> given_;  ///< messages of the present chunk, by channel
  std::deque<int> missing_;                     ///< topics of missing messages that were not handed out
  bool lossy_ = false, doubtful_ = false, at_end_ = false;
};

/// Opens the messages of a recording about joints as a table: sensor_msgs/JointState, the states of
/// controllers (see joint_views()), and the fields that the robot file names. The joints are found in its
/// first part; messages with other joints later are reported as issues. choose() throws Error(input) when
/// there are none.
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
