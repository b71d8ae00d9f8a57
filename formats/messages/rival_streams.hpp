// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "formats/messages/joint_layout.hpp"
#include "lib/core/issue.hpp"

namespace faultline {

/// Counts the messages of streams that could be rows of the log, such as those with other joint names or on
/// another topic, so that each lost one is reported.
class RivalStreams {
 public:
  RivalStreams() = default;
  RivalStreams(const std::vector<JointStream>& streams, const JointLayout& layout);

  /// Counts a message of the stream. If the stream continues without the main one, its messages are rows that
  /// the log lacks; returns the number of rows that this message adds.
  std::int64_t rows_lost_by(int stream);
  /// Counts a row of the log, which takes the latest message of each stream.
  void at_row() {
    if (any_came_) count(1);
  }
  /// Adds a note about the messages that are in no row.
  void report_at_end(Issues& issues);

 private:
  void count(std::int64_t taken);

  std::vector<bool> is_rival_;       ///< by stream, as are most_ and since_
  std::vector<std::int64_t> most_;   ///< messages allowed between two rows
  std::vector<std::int64_t> since_;  ///< messages since the last row
  bool any_came_ = false;            ///< since the last row
  std::int64_t between_rows_ = 0;    ///< messages that are in no row
};

}  // namespace faultline
