// SPDX-License-Identifier: MIT
#include "formats/mcap/mcap_topics.hpp"

#include "formats/bytes/byte_cursor.hpp"

namespace faultline {

void McapTopics::start_recording(std::size_t recording) {
  recording_ = recording;
  if (recordings_.size() <= recording) recordings_.resize(recording + 1);
}

void McapTopics::add_schema(std::string_view content) {
  ByteCursor record(content);
  const auto id = record.take<std::uint16_t>();
  const std::string_view name = record.text();
  if (record.ok()) numbers().type_of_schema.emplace(id, name.substr(0, kLongestTopicText));
}

void McapTopics::add_channel(std::string_view content) {
  ByteCursor record(content);
  const auto id = record.take<std::uint16_t>(), schema = record.take<std::uint16_t>();
  const std::string_view name = record.text(), encoding = record.text();
  if (!record.ok() || numbers().topic_of_channel.count(id)) return;
  const auto type = numbers().type_of_schema.find(schema);
  const bool known = type != numbers().type_of_schema.end();
  numbers().topic_of_channel.emplace(
      id, topics_.add({std::string(name), known ? type->second : "", std::string(encoding)}));
}

int McapTopics::topic_of(std::uint16_t channel) const {
  const auto found = numbers().topic_of_channel.find(channel);
  return found == numbers().topic_of_channel.end() ? -1 : found->second;
}

}  // namespace faultline
