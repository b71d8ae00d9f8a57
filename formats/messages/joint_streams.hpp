// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "formats/messages/joint_state.hpp"
#include "formats/messages/message_source.hpp"

namespace faultline {

/// Joints that messages of one topic speak of together. Two publishers of one topic whose joints differ, such
/// as an arm and its gripper, make two streams.
struct JointStream {
  int topic = 0;
  std::vector<std::string> joints;  ///< in the order of their first message
  std::int64_t messages = 0;
  bool position = false, velocity = false, effort = false;  ///< which of them some message has
  bool stamped = false;                                     ///< some stamp is not 0
  bool received_later = false;                              ///< some receipt is not the stamp
};

/// How the messages with one list of joint names go into their stream.
struct JointPlacing {
  int stream = -1;               ///< -1 for none that was known when the columns were made
  std::vector<int> joint_of;     ///< by place in the message: the joint of the stream, -1 for none
  std::vector<bool> is_present;  ///< by joint of the stream
  bool complete = false;         ///< all joints are there, and no other
};

/// Finds the streams of a recording and leads its messages to them.
class JointStreams {
 public:
  /// Takes the message into account; false when it is no JointState that can be read.
  bool learn(const Topic& topic, const Message& message);
  /// To be called once, when enough messages were learned.
  void settle();
  const std::vector<JointStream>& streams() const { return streams_; }

  /// Reads a message; null when it is no JointState, or is damaged (then `damaged` is set). Both results are
  /// valid until the next call. Beyond the largest number of lists of names, a new list leads to no stream.
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

  JointStateDecoder* decoder_of(const Topic& topic, int index);
  Pattern* pattern_of(int topic, const JointMessage& state, const JointStateDecoder& decoder);
  void join(const Pattern& pattern);
  void place(Pattern& pattern) const;

  std::vector<std::unique_ptr<JointStateDecoder>> decoders_;  ///< by topic
  std::vector<bool> asked_;                                   ///< by topic, whether there is a decoder
  std::vector<std::unique_ptr<Pattern>> patterns_;
  std::vector<Pattern*> last_;                            ///< by topic
  std::unordered_map<std::string, Pattern*> pattern_of_;  ///< by topic and encoded names
  std::vector<JointStream> streams_;
  bool settled_ = false;
};

}  // namespace faultline
