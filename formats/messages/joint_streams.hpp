// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "formats/messages/message_source.hpp"

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
  std::int64_t stamp_ns = 0;            ///< of its header
  std::string_view names;               ///< encoded: equal bytes mean equal names; see decode_names()
  std::array<PackedNumbers, 3> arrays;  ///< positions, velocities, efforts
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

/// Joints that share messages of one topic. Two publishers of one topic with different joints, such as an arm
/// and its gripper, form two streams.
struct JointStream {
  int topic = 0;
  std::vector<std::string> joints;  ///< in the order of their first message
  std::int64_t messages = 0;
  std::array<bool, 3> has{};    ///< some message has this array of JointMessage
  bool stamped = false;         ///< some stamp is not 0
  bool received_later = false;  ///< some receipt time differs from its stamp
};

/// Assigns the messages with one list of joint names to a stream.
struct JointPlacing {
  int stream = -1;               ///< -1 if no stream was known when the columns were made
  std::vector<int> joint_of;     ///< by index in the message: the joint of the stream, -1 for none
  std::vector<bool> is_present;  ///< by joint of the stream
  bool complete = false;         ///< all joints of the stream are present, and no others
};

/// Returns the index of a joint's name; -1 for none.
int index_of(const std::vector<std::string>& names, const std::string& name);
bool share_a_joint(const std::vector<std::string>& a, const std::vector<std::string>& b);

/// Finds the streams of a recording and assigns its messages to them.
class JointStreams {
 public:
  /// Adds the message to the statistics; false when it is no valid JointState.
  bool learn(const Topic& topic, const Message& message);
  /// Forms the streams; call it once, after learn() of enough messages.
  void settle();
  const std::vector<JointStream>& streams() const { return streams_; }

  /// Reads a message; null when it is no JointState, or is damaged (then `damaged` is set). Both results are
  /// valid until the next call. After the largest number of lists of names, a new list gets no stream.
  const JointPlacing* read(const Topic& topic, const Message& message, JointMessage& state, bool& damaged);

 private:
  /// Messages of a topic with the same names.
  struct Pattern {
    int topic = 0;
    std::string encoded;
    std::vector<std::string> names;
    JointStream counted;
    JointPlacing placing;
  };

  /// What is kept of a topic.
  struct TopicReader {
    bool asked = false;                          ///< its decoder was looked up
    std::unique_ptr<JointStateDecoder> decoder;  ///< null if there is none
    Pattern* last = nullptr;                     ///< of its last message
  };

  JointStateDecoder* decoder_of(const Topic& topic, int index);
  Pattern* pattern_of(int topic, const JointMessage& state, const JointStateDecoder& decoder);
  void join(const Pattern& pattern);
  void place(Pattern& pattern) const;

  std::vector<TopicReader> readers_;                     ///< by topic
  std::unordered_map<std::string, Pattern> pattern_of_;  ///< by topic and encoded names
  std::vector<Pattern*> patterns_;                       ///< in the order in which they were met
  std::vector<JointStream> streams_;
  bool settled_ = false;
};

}  // namespace faultline
