// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "formats/messages/message_source.hpp"

namespace faultline {

/// Schemas and channels of an MCAP file, in the order in which they are met.
class McapTopics {
 public:
  /// `path` is used in messages.
  explicit McapTopics(const std::string& path) : topics_(path) {}
  /// Selects the recording of the file, from 0, whose numbers follow; each recording has its own.
  void start_recording(std::size_t recording);
  /// Adds the content of a schema or channel record; damaged and repeated ones are ignored.
  void add_schema(std::string_view content);
  void add_channel(std::string_view content);
  const std::vector<Topic>& all() const { return topics_.all(); }
  /// Returns the topic of a channel id; -1 for an unknown one.
  int topic_of(std::uint16_t channel) const;

 private:
  /// Types and topics of one recording, by their numbers.
  struct Numbers {
    std::map<std::uint16_t, std::string> type_of_schema;
    std::map<std::uint16_t, int> topic_of_channel;
  };
  const Numbers& numbers() const { return recordings_[recording_]; }
  Numbers& numbers() { return recordings_[recording_]; }

  std::vector<Numbers> recordings_ = std::vector<Numbers>(1);
  std::size_t recording_ = 0;
  TopicList topics_;
};

}  // namespace faultline
