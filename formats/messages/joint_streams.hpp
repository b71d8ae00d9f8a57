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

/// Joints that share messages of one topic. Two publishers of one topic with different joints, such as an arm
/// and its gripper, form two streams.
struct JointStream {
  int topic = 0;
  std::vector<std::string> joints;  ///< in the order of their first message
  std::int64_t messages = 0;
  bool position = false, velocity = false, effort = false;  ///< some message has this array
  bool stamped = false;                                     ///< some stamp is not 0
  bool received_later = false;                              ///< some receipt time differs from its stamp
};

/// Assigns the messages with one list of joint names to a stream.
struct JointPlacing {
  int stream = -1;               ///< -1 if no stream was known when the columns were made
  std::vector<int> joint_of;     ///< by index in the message: the joint of the stream, -1 for none
  std::vector<bool> is_present;  ///< by joint of the stream
  bool complete = false;         ///< all joints of the stream are present, and no others
};

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

  JointStateDecoder* decoder_of(const Topic& topic, int index);
  Pattern* pattern_of(int topic, const JointMessage& state, const JointStateDecoder& decoder);
  void join(const Pattern& pattern);
  void place(Pattern& pattern) const;

  std::vector<std::unique_ptr<JointStateDecoder>> decoders_;  ///< by topic
  std::vector<bool> asked_;                                   ///< by topic: its decoder was looked up
  std::vector<std::unique_ptr<Pattern>> patterns_;
  std::vector<Pattern*> last_;                            ///< by topic
  std::unordered_map<std::string, Pattern*> pattern_of_;  ///< by topic and encoded names
  std::vector<JointStream> streams_;
  bool settled_ = false;
};

}  // namespace faultline
