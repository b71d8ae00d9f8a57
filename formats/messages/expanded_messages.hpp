// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "formats/messages/encode_joint_state.hpp"
#include "formats/messages/joint_views.hpp"
#include "formats/messages/message_content.hpp"
#include "formats/messages/message_source.hpp"
#include "lib/log/channels.hpp"

namespace faultline {

/// A recording in which each message of a controller comes after joint states that say the same, one for
/// each of its views, on topics below its own, such as "/arm_controller/state/feedback". The fields that a
/// robot file names are joint states on the topic itself, with the fields as joints and the values as
/// positions.
class ExpandedMessages : public MessageStream {
 public:
  explicit ExpandedMessages(std::unique_ptr<MessageStream> source);

  /// Chooses the fields, with all messages still to come; call rewind() after it.
  void choose(std::vector<MessageFieldName> fields);
  /// Throws Error(input) for a chosen field that no message so far had.
  void require_fields() const;

  const std::string& path() const override { return source_->path(); }
  const char* format() const override { return source_->format(); }
  const std::vector<Topic>& topics() const override { return topics_.all(); }
  bool next(Message& message) override;
  void rewind() override;
  const Issues& issues() const override { return source_->issues(); }
  void spend(std::int64_t work_ns) override { source_->spend(work_ns); }
  const std::string& sha256() const override { return source_->sha256(); }
  double share_read() const override { return source_->share_read(); }

 private:
  /// A topic of joint states that are made of messages.
  struct Output {
    int topic = -1;
    std::vector<std::string> joints;
    std::optional<JointStateEncoder> encoder;  ///< of these joints
  };

  /// A chosen field of a topic.
  struct ChosenField {
    MessageFieldName name;
    FieldPlace place;
    bool found = false;  ///< in some message
  };

  /// What becomes of the messages of a topic.
  struct Expansion {
    int topic = -1;  ///< in the list of this recording
    std::string name, type;
    std::unique_ptr<ContentDecoder> decoder;  ///< null if its messages are handed on alone
    bool has_views = false;
    std::vector<Output> views;  ///< in the order in which they were met
    Output fields;
    std::vector<ChosenField> chosen;
    MessageContent content;
  };

  /// Returns why the messages of a topic have no fields, for an error.
  std::string why_unread(const std::string& name) const;
  Expansion& expansion_of(int source_topic);
  void expand(const Message& message, Expansion& expansion);
  void add_views(const Message& message, Expansion& expansion);
  void add_fields(const Message& message, Expansion& expansion);
  void add_state(const Message& message, Output& output, const std::vector<std::string>& joints,
                 const JointRow& row, std::int64_t stamp_ns);
  /// Hands out a message that cannot be read on the topics that its joint states would have.
  void add_unreadable(const Message& message, const Expansion& expansion);

  std::unique_ptr<MessageStream> source_;
  TopicList topics_;
  std::vector<MessageFieldName> fields_;
  std::vector<Expansion> expansions_;  ///< by topic of the source
  std::deque<Message> waiting_;        ///< made of the last message of the source
  std::deque<std::string> made_;       ///< their bytes
};

}  // namespace faultline
