// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "formats/messages/message_source.hpp"

namespace faultline {

/// Schemas and channels of an MCAP file, as they are met.
class McapTopics {
 public:
  /// Content of a schema or channel record; those that are damaged or known already are passed over.
  void add_schema(std::string_view content);
  void add_channel(std::string_view content);
  const std::vector<Topic>& all() const { return topics_; }
  /// Of a channel id; -1 for one that was not met.
  int topic_of(std::uint16_t channel) const;

 private:
  std::map<std::uint16_t, std::string> type_of_schema_;
  std::map<std::uint16_t, int> topic_of_channel_;
  std::vector<Topic> topics_;
};

}  // namespace faultline
