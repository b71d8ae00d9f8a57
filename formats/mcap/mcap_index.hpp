// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "lib/core/issue.hpp"

namespace faultline {

/// What was met while an MCAP file was read from front to back, against what its summary says of it. The data
/// are right; a summary that says otherwise is told.
class McapIndex {
 public:
  void met_message() { ++messages_; }
  /// A chunk record at this byte, with its head; false when there is no memory for more of them.
  void met_chunk(std::int64_t begin, std::int64_t size);
  /// Content of a chunk index or statistics record of the summary.
  void check_chunk_index(std::string_view content);
  void check_statistics(std::string_view content);
  /// Adds what is wrong with the summary; of a damaged file nothing is expected.
  void tell(bool damaged, Issues& issues) const;

 private:
  std::int64_t messages_ = 0;
  std::map<std::int64_t, std::int64_t> chunks_;  ///< size by first byte
  std::int64_t indexed_ = 0, wrong_chunks_ = 0;
  std::int64_t messages_told_ = -1;  ///< -1: no statistics
};

}  // namespace faultline
