// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "formats/messages/joint_streams.hpp"
#include "lib/core/issue.hpp"
#include "lib/log/channels.hpp"
#include "lib/log/raw_reader.hpp"

namespace faultline {

/// Columns of the values of one array of a stream, by joint of the stream; -1 for none.
using JointColumns = std::vector<int>;

/// The columns of a recording. Rows are the messages of the main stream; the values of other streams are
/// those of their latest message.
struct JointLayout {
  int main = -1;  ///< index of the stream
  std::vector<RawColumn> columns;
  int stamp_column = -1, receipt_column = -1;  ///< s; -1 if the recording lacks it or it is redundant
  /// By stream: the columns of position, velocity and effort.
  std::vector<std::array<JointColumns, 3>> of_stream;
  /// By stream: true when its messages could be rows of the log, such as those of another publisher or with
  /// other names.
  std::vector<bool> is_rival;
  Issues issues;  ///< choices that the user may want to change
};

/// Chooses the columns. The main stream is the one with positions that most resembles a measurement, unless
/// `choice` names its topic. Throws Error(input) naming `path` when no stream fits.
JointLayout layout_joints(const std::vector<Topic>& topics, const std::vector<JointStream>& streams,
                          const RecordingChoice& choice, const std::string& path);

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
