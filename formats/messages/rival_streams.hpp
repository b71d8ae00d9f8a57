// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "formats/messages/joint_layout.hpp"
#include "lib/core/issue.hpp"

namespace faultline {

/// Counts the messages of streams that could be rows of the log, as those under other names of the joints or
/// on another topic, so that none is lost in silence.
class RivalStreams {
 public:
  RivalStreams() = default;
  RivalStreams(const std::vector<JointStream>& streams, const JointLayout& layout);

  /// A message of the stream came. Where it goes on without the main one its messages are rows that the log
  /// lacks; how many became so by this one.
  std::int64_t rows_lost_by(int stream);
  /// A row of the log takes the latest message of each stream.
  void at_row() {
    if (any_came_) count(1);
  }
  /// Adds a note of the messages that stand in no row.
  void tell_end(Issues& issues);

 private:
  void count(std::int64_t taken);

  std::vector<bool> is_rival_;       ///< by stream, as those below
  std::vector<std::int64_t> most_;   ///< messages that may come between two rows
  std::vector<std::int64_t> since_;  ///< messages since the last row
  bool any_came_ = false;            ///< since the last row
  std::int64_t between_rows_ = 0;    ///< messages that stand in no row
};

}  // namespace faultline
