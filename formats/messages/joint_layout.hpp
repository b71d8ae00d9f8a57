// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>
#include <vector>

#include "formats/messages/joint_streams.hpp"
#include "lib/core/issue.hpp"
#include "lib/log/channels.hpp"
#include "lib/log/raw_reader.hpp"

namespace faultline {

/// Columns of the values of one array of a stream, by joint of the stream; -1 for none.
using JointColumns = std::vector<int>;

/// Which columns a recording makes. Rows are the messages of the main stream; the values of the others are
/// those of their latest message.
struct JointLayout {
  int main = -1;  ///< stream
  std::vector<RawColumn> columns;
  int stamp_column = -1, receipt_column = -1;  ///< s; -1 where it says nothing
  /// By stream: the columns of position, velocity and effort.
  std::vector<std::array<JointColumns, 3>> of_stream;
  /// By stream: whether its messages could be rows of the log, as those of another publisher or under other
  /// names.
  std::vector<bool> is_rival;
  Issues issues;  ///< choices that somebody may want to know of
};

/// The stream that has positions and most looks like a measurement is the main one, unless `choice` names its
/// topic. Throws Error(input) naming `path` when no stream fits.
JointLayout layout_joints(const std::vector<Topic>& topics, const std::vector<JointStream>& streams,
                          const RecordingChoice& choice, const std::string& path);

}  // namespace faultline
