// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/core/issue.hpp"
#include "lib/log/channel_names.hpp"
#include "lib/log/channels.hpp"
#include "lib/log/raw_reader.hpp"

namespace faultline {

/// How a canonical channel is computed from a raw column: value = gain * raw + offset.
struct ChannelSource {
  Channel channel;
  int column = -1;              ///< kRowNumber: the row number, from 0, is the raw value
  int nanoseconds_column = -1;  ///< second column of a time in seconds and nanoseconds; -1 for none
  double gain = 1.0;
  double offset = 0.0;
  bool unit_is_stated = false;  ///< by the header of the column or the robot file

  bool unchanged() const { return gain == 1.0 && offset == 0.0 && nanoseconds_column < 0; }
};
inline constexpr int kRowNumber = -2;
/// Column name in a ColumnSpec that stands for the row number; with `scale` as sample period it defines the
/// time of a log without a time column.
inline constexpr const char* kRowNumberName = "@row";

/// Key of a ColumnMap for the column whose first change is a stop of the machine. It is no channel: the
/// column is kept under its own name.
inline constexpr const char* kStopChannel = "stop";

/// The columns of a file that become channels. `joints` is the number of joints that have a position.
struct Matching {
  int joints = 0;
  std::vector<ChannelSource> channels;  ///< time first, then by quantity and joint
  std::vector<int> extra;               ///< columns without a canonical meaning
  Issues issues;                        ///< ambiguous or incomplete channels
};

/// Finds the channels by the column map, else by canonical name, else by the usual names. Throws Error(input)
/// if the time, every position or a mapped column is missing (naming the existing columns and the line of
/// [log.columns] that would map one), and Error(usage) for an unknown channel or unit or a wrong sign.
Matching match_columns(const std::vector<RawColumn>& columns, const ColumnMap& map, const std::string& path);

/// Returns the channels without those of velocity if some joint has none, with an issue: stages that judge
/// rows need the same measurements of all joints.
Matching without_partial_velocity(Matching matching);

/// Returns the error message of match_columns(), empty if it would succeed.
std::string why_no_match(const std::vector<RawColumn>& columns, const ColumnMap& map,
                         const std::string& path);

}  // namespace faultline
