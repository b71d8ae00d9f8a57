// SPDX-License-Identifier: MIT
#include "formats/mcap/mcap_topics.hpp"

#include "formats/bytes/byte_cursor.hpp"

namespace faultline {

void McapTopics::add_schema(std::string_view content) {
  ByteCursor record(content);
  const auto id = record.take<std::uint16_t>();
  const std::string_view name = record.text();
  if (record.ok()) type_of_schema_.emplace(id, name);
}

void McapTopics::add_channel(std::string_view content) {
  ByteCursor record(content);
  const auto id = record.take<std::uint16_t>(), schema = record.take<std::uint16_t>();
  const std::string_view name = record.text(), encoding = record.text();
  if (!record.ok() || topic_of_channel_.count(id)) return;
  const auto type = type_of_schema_.find(schema);
  topic_of_channel_.emplace(
      id, add_topic(topics_, {std::string(name), type == type_of_schema_.end() ? "" : type->second,
                              std::string(encoding)}));
}

int McapTopics::topic_of(std::uint16_t channel) const {
  const auto found = topic_of_channel_.find(channel);
  return found == topic_of_channel_.end() ? -1 : found->second;
}

}  // namespace faultline
