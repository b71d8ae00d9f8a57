// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "formats/messages/message_source.hpp"

namespace faultline {

/// Messages that are missing from damaged chunks, as the index behind each tells. Channels are numbered as
/// the file does.
class LostMessages {
 public:
  /// The chunk that begins is whole until lose().
  void begin_chunk();
  void lose() { lossy_ = true; }
  bool is_lossy() const { return lossy_; }
  /// A message of the chunk was handed out.
  void met(std::uint32_t channel) { ++met_[channel]; }
  /// The index behind the chunk: of those messages of a topic the ones that were not met are missing.
  void told(std::uint32_t channel, std::size_t messages, int topic);
  /// The next missing one; false when there is none.
  bool next(Message& message);

 private:
  std::map<std::uint32_t, std::size_t> met_;  ///< in the present chunk
  std::vector<int> topics_;                   ///< of missing messages
  std::size_t given_ = 0;
  bool lossy_ = false;
};

}  // namespace faultline
