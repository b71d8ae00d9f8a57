// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "formats/messages/message_source.hpp"

namespace faultline {

/// Finds the messages that are missing in damaged chunks by the index after each chunk. Channels have the
/// numbers of the file.
class LostMessages {
 public:
  /// Begins a chunk, which is complete unless lose() is called.
  void begin_chunk();
  void lose() { lossy_ = true; }
  bool is_lossy() const { return lossy_; }
  /// Counts a message of the chunk that was handed out.
  void met(std::uint32_t channel) { ++met_[channel]; }
  /// Takes the index after the chunk; messages of a topic beyond those counted by met() are missing.
  void told(std::uint32_t channel, std::size_t messages, int topic);
  /// Returns the next missing message; false when there is none.
  bool next(Message& message);

 private:
  std::map<std::uint32_t, std::size_t> met_;  ///< in the present chunk
  std::vector<int> topics_;                   ///< of missing messages
  std::size_t given_ = 0;
  bool lossy_ = false;
};

}  // namespace faultline
