// SPDX-License-Identifier: MIT
#include "formats/messages/expanded_messages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "lib/core/error.hpp"
#include "lib/log/raw_reader.hpp"

namespace faultline {
namespace {

/// Type of the topics of views, type of the topics of fields, and encoding of both.
constexpr const char* kViewType = JointStateEncoder::kType;
constexpr const char* kFieldsType = "faultline/Fields";
constexpr const char* kMadeEncoding = "cdr";
constexpr std::size_t kListedFields = 30;  ///< that an error lists
constexpr std::int64_t kDecodedByte_ns = 2;

/// Returns the numeric fields of a message as a robot file writes them, such as "q[0]".
std::string listed_fields(const MessageContent& content) {
  std::string text;
  std::size_t listed = 0;
  for (const FieldContent& field : content.fields) {
    if (field.is_text || field.runs.empty()) continue;
    if (++listed > kListedFields) return text + ", ..";
    text += (text.empty() ? "" : ", ") + field.example;
  }
  return text.empty() ? "none" : text;
}

}  // namespace

ExpandedMessages::ExpandedMessages(std::unique_ptr<MessageStream> source)
    : source_(std::move(source)), topics_(source_->path()) {}

void ExpandedMessages::choose(std::vector<MessageFieldName> fields) {
  fields_ = std::move(fields);
  expansions_.clear();
}

void ExpandedMessages::require_fields() const {
  for (const MessageFieldName& field : fields_) {
    const Expansion* holder = nullptr;
    bool found = false;
    for (const Expansion& expansion : expansions_)
      for (const ChosenField& chosen : expansion.chosen) {
        if (chosen.name.topic != field.topic || chosen.name.field != field.field) continue;
        holder = &expansion;
        found = found || chosen.found;
      }
    if (found) continue;
    const std::string wanted =
        fmt::format("has no field {} on the topic {}, although the robot file names it",
                    in_quotes(field.field), in_quotes(field.topic));
    if (!holder) throw Error(ErrorCode::input, path(), wanted + "; " + why_unread(field.topic));
    throw Error(
        ErrorCode::input, path(),
        fmt::format("{}; the numeric fields of its messages are {}", wanted, listed_fields(holder->content)));
  }
}

std::string ExpandedMessages::why_unread(const std::string& name) const {
  for (const Topic& topic : topics_.all())
    if (topic.name == name)
      return fmt::format(
          "its messages ({}, {}) cannot be read, because the recording does not state the "
          "definition of their type, or has it in another language than that of ROS",
          in_quotes(topic.type), in_quotes(topic.encoding));
  return "the recording has no messages of this topic; " + topics_sentence(topics_.all());
}

bool ExpandedMessages::next(Message& message) {
  while (waiting_.empty()) {
    Message found;
    if (!source_->next(found)) return false;
    made_.clear();
    Expansion& expansion = expansion_of(found.topic);
    Message own = found;
    own.topic = expansion.topic;
    if (!expansion.decoder) return message = own, true;
    expand(own, expansion);
  }
  message = waiting_.front();
  waiting_.pop_front();
  return true;
}

void ExpandedMessages::rewind() {
  source_->rewind();
  waiting_.clear();
  made_.clear();
}

ExpandedMessages::Expansion& ExpandedMessages::expansion_of(int source_topic) {
  const auto at = static_cast<std::size_t>(source_topic);
  if (at >= expansions_.size()) expansions_.resize(at + 1);
  Expansion& expansion = expansions_[at];
  if (expansion.topic >= 0) return expansion;
  const Topic& topic = source_->topics()[at];
  expansion.topic = topics_.add(topic);
  expansion.name = topic.name;
  expansion.type = topic.type;
  expansion.has_views = has_joint_views(topic.type);
  for (const MessageFieldName& field : fields_)
    if (const auto place = field_place(field.field); place && field.topic == topic.name)
      expansion.chosen.push_back({field, *place, false});
  if (expansion.has_views || !expansion.chosen.empty()) expansion.decoder = content_decoder(topic);
  if (!expansion.decoder) expansion.chosen.clear();
  if (expansion.chosen.empty()) return expansion;
  std::vector<std::string> names;
  for (const ChosenField& chosen : expansion.chosen) names.push_back(chosen.name.field);
  Topic made{topic.name, kFieldsType, kMadeEncoding};
  made.role = TopicRole::fields;
  expansion.fields = {topics_.add(made), names, JointStateEncoder(names)};
  return expansion;
}

void ExpandedMessages::expand(const Message& message, Expansion& expansion) {
  spend(kMessageWork_ns + kDecodedByte_ns * std::ssize(message.bytes));
  if (message.lost || !expansion.decoder->decode(message.bytes, expansion.content)) {
    add_unreadable(message, expansion);
  } else {
    if (!expansion.chosen.empty()) add_fields(message, expansion);
    if (expansion.has_views) add_views(message, expansion);
  }
  waiting_.push_back(message);
}

void ExpandedMessages::add_unreadable(const Message& message, const Expansion& expansion) {
  Message made{expansion.fields.topic, message.receipt_ns, {}, message.lost};
  if (made.topic >= 0) waiting_.push_back(made);
  for (const Output& output : expansion.views) {
    made.topic = output.topic;
    waiting_.push_back(made);
  }
}

void ExpandedMessages::add_fields(const Message& message, Expansion& expansion) {
  JointRow row;
  for (ChosenField& chosen : expansion.chosen) {
    row[0].push_back(number_at(expansion.content, chosen.place));
    chosen.found = chosen.found || row[0].back() == row[0].back();
  }
  add_state(message, expansion.fields, expansion.fields.joints, row, stamp_of(expansion.content));
}

void ExpandedMessages::add_views(const Message& message, Expansion& expansion) {
  const std::int64_t stamp_ns = stamp_of(expansion.content);
  for (const JointView& view : joint_views(expansion.type, expansion.content)) {
    Topic made{expansion.name + "/" + view.name, kViewType, kMadeEncoding};
    made.role = view.role;
    const int topic = topics_.add(made);
    auto output = std::find_if(expansion.views.begin(), expansion.views.end(),
                               [&](const Output& known) { return known.topic == topic; });
    if (output == expansion.views.end()) output = expansion.views.insert(output, {topic, {}, {}});
    add_state(message, *output, view.joints, view.row, stamp_ns);
  }
}

void ExpandedMessages::add_state(const Message& message, Output& output,
                                 const std::vector<std::string>& joints, const JointRow& row,
                                 std::int64_t stamp_ns) {
  if (!output.encoder || output.joints != joints) {
    output.joints = joints;
    output.encoder.emplace(joints);
  }
  made_.emplace_back();
  output.encoder->append(stamp_ns, row, made_.back());
  waiting_.push_back({output.topic, message.receipt_ns, made_.back(), false});
}

}  // namespace faultline
