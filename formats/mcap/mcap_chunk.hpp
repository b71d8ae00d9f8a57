// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "formats/mcap/mcap_topics.hpp"

namespace faultline {

/// The messages of an unpacked chunk of an MCAP file in the order of their times, whatever theirs is in the
/// chunk.
class McapChunk {
 public:
  /// Goes through the chunk once for what it defines, and for the order of its messages. `inside` must
  /// outlive it.
  void begin(std::string_view inside, McapTopics& topics);
  /// The content of the next message; false behind the last.
  bool next(std::string_view& content);
  void close();

 private:
  struct Place {
    std::uint64_t log_time_ns = 0;
    std::uint32_t begin = 0, size = 0;  ///< of the content in the chunk
  };
  void sort(std::size_t messages);

  std::string_view all_, left_;
  std::vector<Place> sorted_;  ///< where they are not in the order of their times
  std::size_t next_sorted_ = 0;
};

}  // namespace faultline
