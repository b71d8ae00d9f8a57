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

}  // namespace faultline
